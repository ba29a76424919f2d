#pragma once
#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "pictures/pictures.hpp"

namespace antilock::figures {

/// The options of the command line. Each subcommand fills those that it has.
struct Request {
  std::string out, title;
  std::vector<std::string> inputs, titles;
  std::vector<double> range, own_range, window;
  bool check_layout = false, half = false, no_regions = false;
  int compression = 8;
  std::string own_name = "$u$";
  std::optional<double> height_factor;
  int grid = 0;
  ChartStyle chart;
  PlanStyle plan;
  CutStyle cut;
  DeformedStyle deformed;
  CurvesStyle curves;
  MapStyle map;
  BarStyle bars;
  std::function<Page()> draw;
};

/// Adds one subcommand per kind of picture to the command line.
void add_pictures(CLI::App& app, Request& request);

}  // namespace antilock::figures
