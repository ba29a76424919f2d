#pragma once
#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include "pictures/pictures.hpp"

namespace antilock::figures {

/// What the command line asks for; each subcommand fills its part.
struct Request {
  std::string out, title;
  std::vector<std::string> inputs, titles;
  std::vector<double> range{-0.25, 0.25}, own_range, window{0, 1, -1, 1};
  bool check_layout = false;
  int compression = 8;
  std::string own_name = "$u$";
  double height_factor = 2;
  int grid = 0;
  ChartStyle chart;
  PlanStyle plan;
  DeformedStyle deformed;
  CurvesStyle curves;
  MapStyle map;
  BarStyle bars;
  std::function<Page()> draw;
};

/// Adds one subcommand per kind of picture to the command line.
void add_pictures(CLI::App& app, Request& request);

}  // namespace antilock::figures
