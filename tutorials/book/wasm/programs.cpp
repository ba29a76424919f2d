// The programs of tutorials/ in one module: which one runs is the first word of its command
// line, as on the machine. programs.inc has PROGRAM(first word, chapter, its function) per
// program (build).
#include <fmt/format.h>

#include <cstdio>
#include <string_view>

#define PROGRAM(name, chapter, function)   \
  namespace program_##chapter {            \
    int function(int count, char** words); \
  }
#include "programs.inc"
#undef PROGRAM

int main(int count, char** words) {
  std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);  // the page shows each line as it comes
  const std::string_view asked = count > 0 ? words[0] : "";
#define PROGRAM(name, chapter, function) \
  if (asked == #name) return program_##chapter::function(count, words);
#include "programs.inc"
#undef PROGRAM
  fmt::print(stderr, "the page has no program {}\n", asked);
  return 2;
}
