#include "common/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>

#include "antilock/io/expression.hpp"
#include "common/hand_over.hpp"

namespace antilock::tutorial {

CommandLine::CommandLine(const std::string& what, std::string name)
    : app_(std::make_unique<CLI::App>(what, name)), name_(std::move(name)) {}
CommandLine::~CommandLine() = default;

void CommandLine::add(const std::string& option, double& value, const std::string& what, double least, double most) {
  app_->add_option(option, value, what)->capture_default_str()->check(CLI::Range(least, most));
  numbers_.emplace_back(option, &value);
}

void CommandLine::add(const std::string& option, int& value, const std::string& what, int least, int most) {
  app_->add_option(option, value, what)->capture_default_str()->check(CLI::Range(least, most));
}

void CommandLine::add(const std::string& option, std::string& value, const std::string& what) {
  app_->add_option(option, value, what)->capture_default_str();
}

void CommandLine::add(const std::string& option, std::filesystem::path& value, const std::string& what) {
  app_->add_option(option, value, what)->capture_default_str();
}

void CommandLine::add(const std::string& option, std::vector<std::filesystem::path>& values, const std::string& what) {
  app_->add_option(option, values, what)->expected(static_cast<int>(values.size()));
}

void CommandLine::add(const std::string& option, bool& value, const std::string& what) {
  app_->add_flag(option, value, what);
}

void CommandLine::add_required(const std::string& name, std::filesystem::path& value, const std::string& what) {
  app_->add_option(name, value, what)->required();
}

void CommandLine::footer(const std::string& text) { app_->footer(text); }

std::optional<int> CommandLine::parse(int argc, char** argv) {
  const auto refuse = [&](const std::string& message) {
    if (!silent_) fmt::print(stderr, "{}: {} (see --help)\n", name_, printable(message, 4000));
    return 2;
  };
  try {
    app_->parse(argc, argv);
  } catch (const CLI::CallForHelp& help) {
    return silent_ ? 0 : app_->exit(help);
  } catch (const CLI::ParseError& error) {
    return refuse(error.what());
  }
  for (const auto& [option, value] : numbers_)  // NaN is in any range for CLI11
    if (std::isnan(*value)) return refuse(option + ": nan; accepted: a number");
  choose_kernels(argv);
  return std::nullopt;
}

bool CommandLine::given(const std::string& option) const { return app_->count(option) > 0; }

}  // namespace antilock::tutorial
