// The layout check must see each fault that it is there for, and the table of looks must hold what
// it promises.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "antilock/core/error.hpp"
#include "drawing/colour_bar.hpp"
#include "drawing/page.hpp"
#include "drawing/styles.hpp"
#include "pictures/pictures.hpp"

namespace antilock::figures {
namespace {

/// A page with one good text; each test adds what is wrong.
Page good_page() {
  Page page(1000);
  page.text({960, 500}, "distance to the limit in $H^1$", {48, {0.5}});
  return page;
}

std::string fault(const Page& page) { return page.layout_fault().value_or("none"); }

TEST(Layout, AGoodPageHasNoFault) {
  EXPECT_EQ(fault(good_page()), "none");
  EXPECT_DOUBLE_EQ(good_page().smallest_type(),
                   9);  // the script: 3/4 of 48 pixels, shown at a quarter of the page's width
}

TEST(Layout, EveryFaultIsSeen) {
  struct Added {
    Point at;
    std::string text;
    TextStyle look;
    std::string fault;
  };
  for (const Added& added : {Added{{960, 300}, "small", {35}, "type of 8.8 pixels in \"small\""},
                             Added{{960, 300}, "$10^{−6}$", {47}, "8.8 pixels"},
                             Added{{960, 520}, "over it", {48, {0.5}}, "overlap"},
                             Added{{960, 500}, "across it, from below", {48, {0.5}, 90}, "overlap"},
                             Added{{200, 500}, "a vertical axis", {48, {0.5}, 90}, "none"},
                             Added{{-20, 300}, "edge", {48}, "\"edge\" leaves the page"},
                             Added{{1880, 300}, "edge", {48}, "\"edge\" leaves the page"},
                             Added{{300, -20}, "edge", {48}, "\"edge\" leaves the page"},
                             Added{{300, 990}, "edge", {48}, "\"edge\" leaves the page"},
                             Added{{960, 300},
                                   "Crouzeix–Raviart, unstructured mesh",
                                   {52, {0.5}, 0, palette::ink, 500},
                                   "its place holds 500"}}) {
    Page page = good_page();
    page.text(added.at, added.text, added.look);
    EXPECT_NE(fault(page).find(added.fault), std::string::npos)
        << added.text << ": " << fault(page);
  }
}

/// The message with which a picture of the table is refused.
template <class Picture>
std::string refusal(const std::string& table, Picture&& picture) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "layout_test.csv";
  std::ofstream(file) << table;
  try {
    picture(file);
  } catch (const Error& error) {
    return error.what();
  }
  return "none";
}

// matplotlib #2872 and #7493 are on axes of values without a logarithm.
TEST(Chart, OfZerosIsRefusedInATrueSentence) {
  const std::string zeros = "h,error\n0.5,0\n0.25,0\n";
  for (const bool linear_y : {false, true}) {
    ChartStyle style;
    style.x = "h";
    style.y = "error";
    style.linear_y = linear_y;
    EXPECT_NE(refusal(zeros, [&](const auto& file) { chart_picture(file, style); })
                  .find("no row to draw: h and error are finite and above 0 in none; accepted: one "
                        "such row or more"),
              std::string::npos);
  }
  MapStyle map;
  map.x = map.y = "h";
  map.z = "error";
  EXPECT_NE(refusal(zeros, [&](const auto& file) { map_picture(file, map); })
                .find("no row to draw: h, h and error are finite and above 0 in none"),
            std::string::npos);
  BarStyle bars;
  bars.bar_by = {"h"};
  bars.parts = {"error", "error"};
  EXPECT_NE(refusal(zeros, [&](const auto& file) { bar_picture(file, bars); })
                .find("no row to draw: the sum of error + error is above 0 in none"),
            std::string::npos);
}

// VTK takes the number of corners from `offsets`, whatever `types` says: a triangle of one corner
// was read beyond its end.
TEST(Surface, OfATriangleWithoutThreeCornersIsRefused) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "layout_test.vtu";
  std::ofstream(file)
      << R"(<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian">
<UnstructuredGrid><Piece NumberOfPoints="3" NumberOfCells="1">
<PointData><DataArray type="Float64" Name="u" format="ascii">0 1 2</DataArray></PointData>
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0</DataArray>
</Points><Cells><DataArray type="Int32" Name="connectivity" format="ascii">0 1 2</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">1</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">5</DataArray></Cells>
</Piece></UnstructuredGrid></VTKFile>)";
  try {
    plan_picture({{file, ""}}, {});
    FAIL() << "is drawn";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("cell 0 is a triangle with 1 corner"),
              std::string::npos)
        << error.what();
  }
}

// vedo #212 and Sunny.jl #309: fields of 1e-200, whose numbers have exponents of three digits.
TEST(ColourBar, OfTinyValuesStaysOnThePage) {
  for (const Range& range :
       {Range{0, 1}, {-3.3e-200, 1.7e-200}, {1.25e-300, 1.75e-300}, {0, 2e100}}) {
    Page page(1000);
    const double left = Page::width - colour_bar_room(range, 20, 0) + 20;
    draw_colour_bar(page, {left, 200, bar_width, 600}, range, "$u$");
    EXPECT_EQ(fault(page), "none") << range.low << " " << range.high;
  }
}

/// Relative luminance, as in the contrast ratio of WCAG 2.
double luminance(const Colour& colour) {
  const auto linear = [](double c) {
    return c <= 0.03928 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(colour[0]) + 0.7152 * linear(colour[1]) + 0.0722 * linear(colour[2]);
}

TEST(Styles, EveryLineStandsOutFromWhite) {
  for (const std::string& key : known_keys()) {
    const Colour colour = meaning_of(key).look.colour;
    EXPECT_GT(1.05 / (luminance(colour) + 0.05), 3)
        << key;  // the ratio that WCAG 2 asks of graphics
  }
}

TEST(Styles, WhatLocksIsStrongest) {
  for (const char* other :
       {"P1 structured", "P1 layered", "CR structured", "CR unstructured", "P2", "P3", "P4"})
    EXPECT_GT(meaning_of("P1 unstructured").look.width, meaning_of(other).look.width) << other;
  for (const char* other : {"1", "0.1", "0.01", "0.001", "0.0001", "1e-05"})
    EXPECT_GT(meaning_of({"epsilon"}, {"1e-6"}).look.width,
              meaning_of({"epsilon"}, {other}).look.width)
        << other;
}

TEST(Styles, MethodsDifferInColourAndInMarker) {
  std::vector<Look> looks;
  for (const char* key :
       {"P1 structured", "P1 unstructured", "CR structured", "CR unstructured", "P2"})
    looks.push_back(meaning_of(key).look);
  for (std::size_t i = 0; i < looks.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      EXPECT_NE(looks[i].colour, looks[k].colour) << i << ", " << k;
      EXPECT_NE(looks[i].marker, looks[k].marker) << i << ", " << k;
    }
}

TEST(Styles, ANumberHasOneMeaningHoweverItIsWritten) {
  EXPECT_EQ(meaning_of({"epsilon"}, {"1e-06"}).name, meaning_of({"epsilon"}, {"0.000001"}).name);
  EXPECT_EQ(meaning_of({"element", "mesh"}, {"P1", "unstructured"}).name,
            meaning_of("P1 unstructured").name);
}

// A chart of one curve: it has no column that names its series, and takes the first look of its
// own.
TEST(Styles, ASeriesOfNoColumnIsNotInTheTable) { EXPECT_FALSE(meaning_of({}, {}).known); }

TEST(Styles, PanelsComeInOneOrder) {
  const auto rank = [](const char* element, const char* mesh) {
    return meaning_of({"element", "mesh"}, {element, mesh}).rank;
  };
  EXPECT_LT(rank("P1", "structured"), rank("P1", "unstructured"));
  EXPECT_LT(rank("P1", "unstructured"), rank("CR", "structured"));
  EXPECT_LT(rank("CR", "structured"), rank("CR", "unstructured"));
}

TEST(Styles, WhatTheTableDoesNotHaveIsItsOwnName) {
  const Meaning own = meaning_of({"solver"}, {"my own solver"});
  EXPECT_FALSE(own.known);
  EXPECT_EQ(own.name, "my own solver");
}

}  // namespace
}  // namespace antilock::figures
