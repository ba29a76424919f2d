// render: one picture from files that the tutorials wrote.
//
// Run: render surface results/05_p1_structured/solution.vtu --out figure5.png
// Run: render convergence results/09_convergence/results.csv --out figure9.png
#include <fmt/format.h>
#include <vtkLogger.h>
#include <vtkObject.h>

#include <cstdio>

#include "antilock/core/atomic_file.hpp"
#include "antilock/core/standard_output.hpp"
#include "render/display.hpp"
#include "render/options.hpp"

namespace {

using namespace antilock::figures;

int fail(const std::string& message) {
  std::fputs(("render: " + message + "\n").c_str(),
             stderr);  // fmt::print would throw where it is full or closed
  return 2;
}

int draw(int argc, char** argv) {
  CLI::App app{
      "Renders one picture (PNG) from files that the tutorials wrote. Needs a display: see "
      "xvfb-run."};
  app.require_subcommand(1);
  Request request;
  add_pictures(app, request);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    return fail(std::string(error.what()) + " (see --help)");
  }
  for (const std::string& input : request.inputs)
    antilock::check_not_an_input(request.out, {input});
  const DisplayConnection display = connect_display();
  vtkObject::GlobalWarningDisplayOff();  // what goes wrong is said in one line, below
  vtkLogger::SetStderrVerbosity(
      vtkLogger::VERBOSITY_WARNING);  // VTK 9.3 logs each line that it cuts out of a surface
  const Page page = request.draw();
  if (request.check_layout) {
    if (const auto fault = page.layout_fault()) return fail(*fault);
    fmt::print("smallest type {:.2f} pixels where the picture is {} wide\n", page.smallest_type(),
               shown_width);
  }
  page.save(request.out, request.compression, request.half);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    antilock::open_standard_streams();
    return antilock::delivered(draw(argc, argv), "render");
  } catch (const std::exception& error) {
    return fail(error.what());
  }
}
