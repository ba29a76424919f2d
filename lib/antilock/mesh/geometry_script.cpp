#include "antilock/mesh/geometry_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <vector>

#include "antilock/core/error.hpp"

namespace antilock {
namespace {

using Words = std::set<std::string, std::less<>>;

// Each of these words was looked up in gmsh's grammar (Gmsh.y, Gmsh.l of 4.8 to 4.15): beside
// numbers, signs and variables none of them leads to a rule that opens a file, starts a program or
// changes an option, in whatever order. Macro, Call, If and Return are not among them: gmsh looks
// for the end of what it skips letter by letter, inside texts too, and a jump may so end where no
// statement begins. A loop keeps its statements, and its end is found by words.
const Words commands = {
    // shapes, and what they are made of
    "Point", "Line", "Curve", "Circle", "Ellipse", "Ellipsis", "Spline", "CatmullRom", "BSpline",
    "Bezier", "Wire", "Plane", "Ruled", "Surface", "Rectangle", "Disk", "Volume", "Box", "Block",
    "Sphere", "Cylinder", "Cone", "Torus", "Wedge",
    // what is done to them
    "Translate", "Rotate", "Symmetry", "Dilate", "Affine", "Extrude", "Layers", "Recombine",
    "Delete", "Recursive", "Coherence", "BooleanUnion", "BooleanFuse", "BooleanIntersection",
    "BooleanCommon", "BooleanDifference", "BooleanCut", "BooleanFragments", "BooleanCoherence",
    // what is asked of them
    "In", "BoundingBox", "newp", "newl", "newc", "newll", "news", "newsl", "newv", "newf", "newreg",
    // numbers
    "Pi", "Exp", "Log", "Log10", "Sqrt", "Sin", "Asin", "ArcSin", "Cos", "Acos", "ArcCos", "Tan",
    "Atan", "ArcTan", "Atan2", "ArcTan2", "Sinh", "Cosh", "Tanh", "Fabs", "Abs", "Floor", "Ceil",
    "Round", "Fmod", "Modulo", "Hypot", "Min", "Max", "List", "LinSpace", "Unique"};

// Commands that are no keywords of gmsh's scanner: it reads them as names, and would take them for
// variables elsewhere. So each of them is accepted in its own form alone (named_command).
const Words named_commands = {"Loop", "Duplicata", "Boundary", "CombinedBoundary", "PointsOf"};

// Numbers of gmsh's that depend on the Physical statements before them.
const Words counted_numbers = {"newl",  "newc", "newll",  "newcl",   "news",
                               "newsl", "newv", "newreg", "Extrude", "Duplicata"};

// Statements that are left out may hold these words beside variables, fields and the names of
// options. None of them changes the drawing or a variable, so that nothing is missed.
const Words without_effect = {
    "Point", "Line", "Curve", "Surface", "Volume", "In", "BoundingBox", "newp", "newl", "newc",
    "newll", "newcl", "news", "newsl", "newv", "newf", "newreg", "Pi", "Exp", "Log", "Log10",
    "Sqrt", "Sin", "Asin", "ArcSin", "Cos", "Acos", "ArcCos", "Tan", "Atan", "ArcTan", "Atan2",
    "ArcTan2", "Sinh", "Cosh", "Tanh", "Fabs", "Abs", "Floor", "Ceil", "Round", "Fmod", "Modulo",
    "Hypot", "Min", "Max", "List", "LinSpace", "Unique", "Field", "Length", "Using", "Progression",
    "Power", "Bump", "Beta", "Left", "Right", "Alternate", "AlternateLeft", "AlternateRight",
    "Sprintf", "Str", "StrCat",
    // the menu of a constant
    "Name", "Label", "Help", "Units", "Step", "Range", "Choices", "Visible", "ReadOnly",
    "ReadOnlyRange", "Highlight", "AutoCheck", "Closed", "NumberFormat"};

// Accepted at the beginning of a statement alone, each in its own form.
const Words openings = {"For", "EndFor", "DefineConstant", "SetFactory", "Geometry"};

// Statements that begin so concern the mesh or the screen, and are left out.
const Words mesh_alone = {"Mesh",
                          "Physical",
                          "Field",
                          "Background",
                          "Characteristic",
                          "MeshSize",
                          "Transfinite",
                          "Recombine",
                          "Smoother",
                          "Periodic",
                          "MeshSizeFromBoundary",
                          "MeshAlgorithm",
                          "Reverse",
                          "ReverseMesh",
                          "BoundaryLayer",
                          "Printf"};

// Fields of mesh sizes; those that read files or start programs (Structured, PostView,
// ExternalProcess) are refused.
const Words fields = {"Attractor",
                      "AttractorAnisoCurve",
                      "AutomaticMeshSizeField",
                      "Ball",
                      "BoundaryLayer",
                      "Box",
                      "Constant",
                      "Curvature",
                      "Cylinder",
                      "Distance",
                      "Extend",
                      "Frustum",
                      "Gradient",
                      "IntersectAniso",
                      "Laplacian",
                      "LonLat",
                      "MathEval",
                      "MathEvalAniso",
                      "Max",
                      "MaxEigenHessian",
                      "Mean",
                      "Min",
                      "MinAniso",
                      "Param",
                      "Restrict",
                      "Sphere",
                      "Threshold"};

// Numbers that change curves. The other options of Geometry concern the screen, or are texts.
const Words geometry_options = {"Tolerance",
                                "ToleranceBoolean",
                                "AutoCoherence",
                                "CopyMeshingMethod",
                                "MatchMeshTolerance",
                                "ExtrudeReturnLateralEntities",
                                "ExtrudeSplinePoints",
                                "OldCircle",
                                "OldNewReg",
                                "OldRuledSurface",
                                "OCCAutoFix",
                                "OCCBooleanPreserveNumbering",
                                "OCCFixDegenerated",
                                "OCCFixSmallEdges",
                                "OCCFixSmallFaces",
                                "OCCMakeSolids",
                                "OCCSewFaces",
                                "OCCUnionUnify",
                                "OCCUseGenericClosestPoint"};

const Words assignments = {"=", "+=", "-=", "*=", "/="};

// Signs that are accepted: all of gmsh's but `.` and `::` (members of structures and options), `%`
// (by 0 it ends the program), and those of bits, of which `>>` is Printf's, too.
const Words signs = {
    "(", ")", "[", "]", "{", "}", ",", ";", ":", "...", "=",  "+=", "-=", "*=", "/=", "++", "--",
    "+", "-", "*", "/", "^", "?", "!", "<", ">", "<=",  ">=", "==", "!=", "&&", "||", "~",  "#"};

// Signs that gmsh reads as one, the longest first.
constexpr std::string_view long_signs[] = {"...", "+=", "-=", "*=", "/=", "::", "||", "&&",
                                           "++",  "--", "==", "!=", "<=", ">=", ">>", "<<"};

constexpr const char* accepted =
    "accepted: points, curves, surfaces, transformations, Boolean operations, variables, "
    "arithmetic, For, "
    "DefineConstant, SetFactory";

struct Token {
  enum class Kind { word, number, text, sign };
  Kind kind;
  std::string text;
  int line;
  bool first = false;       // of a statement
  bool open_line = false;   // a comment behind it begins on its line and ends in another part
  std::size_t partner = 0;  // of a bracket: its other half

  bool is(std::string_view wanted) const { return kind != Kind::text && text == wanted; }
  bool is_word() const { return kind == Kind::word; }
};

[[noreturn]] void refuse(int line, std::string_view what, const std::string& why) {
  throw Error(fmt::format("line {}: {}: {}", line, printable(what), why));
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

/// Cuts a script into tokens, by the rules of gmsh's own scanner.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {
    if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;  // the byte order mark of UTF-8
    if (const auto nul = text.find('\0'); nul != text.npos)
      refuse(1 + static_cast<int>(std::count(
                     text.begin(), text.begin() + static_cast<std::ptrdiff_t>(nul), '\n')),
             "a byte 0", "is no sign of a script; accepted: text");
  }

  std::vector<Token> tokens() {
    std::vector<Token> all;
    for (;;) {
      const std::size_t from = at_, start = line_start_;
      const bool more = skip_blanks();
      if (!all.empty()) all.back().open_line = ends_elsewhere(from, start);
      if (!more) break;
      const int line = line_;
      const auto [kind, length] = next();
      std::string taken(text_.substr(at_, length));
      advance(length);
      all.push_back({kind, std::move(taken), line});
    }
    return all;
  }

 private:
  using Kind = Token::Kind;

  char sign(std::size_t ahead = 0) const {
    return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
  }
  void advance(std::size_t length) {
    const std::string_view passed = text_.substr(at_, length);
    line_ += static_cast<int>(std::count(passed.begin(), passed.end(), '\n'));
    if (const auto last = passed.rfind('\n'); last != passed.npos) line_start_ = at_ + last + 1;
    at_ += length;
  }
  /// Behind `closing`, which is looked for from `from` on. Throws Error where it is missing.
  std::size_t length_to(std::string_view closing, std::size_t from, std::string_view name) const {
    const std::size_t end = text_.find(closing, at_ + from);
    if (end == text_.npos)
      refuse(line_, name, fmt::format("has no end; accepted: {} behind it", closing));
    return end + closing.size() - at_;
  }

  /// Whether a comment between `from` and the end of its line, which begins at `start`, is open
  /// where gmsh may end a part of the text: at a line feed, at a carriage return, and behind 8192
  /// signs. From `from` to the place that is reached there are blanks and comments alone.
  bool ends_elsewhere(std::size_t from, std::size_t start) const {
    constexpr std::size_t longest = 4000;
    for (std::size_t at = from; at < at_ && text_[at] != '\n';) {
      if (text_[at] != '/') {
        ++at;
        continue;
      }
      const bool block = text_[at + 1] == '*';
      const std::size_t line_end = std::min(text_.find('\n', at), text_.size());
      const std::size_t end = block ? text_.find("*/", at + 2) + 2 : line_end;
      const std::size_t part = std::min(text_.find_first_of("\n\r", at), text_.size());
      const bool split = part + 1 < end;  // "\r\n" behind // ends the line
      if (split || end - start > longest) return true;
      at = end;
    }
    return false;
  }

  /// Behind blanks and comments; whether anything follows.
  bool skip_blanks() {
    while (at_ < text_.size()) {
      if (sign() == '\r' && sign(1) != '\n')
        refuse(line_, "a carriage return",
               "ends no line for gmsh; accepted: lines that end in a line feed");
      if (std::string_view(" \t\n\r\f").find(sign()) != std::string_view::npos)
        advance(1);
      else if (sign() == '/' && sign(1) == '/')
        advance(std::min(text_.find('\n', at_), text_.size()) - at_);
      else if (sign() == '/' && sign(1) == '*')
        advance(length_to("*/", 2, "/*"));
      else
        return true;
    }
    return false;
  }

  std::pair<Kind, std::size_t> next() const {
    if (is_letter(sign())) return {Kind::word, word_length()};
    if (is_digit(sign()) || (sign() == '.' && is_digit(sign(1))))
      return {Kind::number, number_length()};
    if (sign() == '"')
      return {Kind::text, length_to("\"", 1, "a text")};  // a backslash hides no quotation mark
    if (sign() == '\'') return {Kind::text, length_to("'", 1, "a text")};
    for (const std::string_view s : long_signs)
      if (text_.substr(at_, s.size()) == s) return {Kind::sign, s.size()};
    return {Kind::sign, 1};
  }
  std::size_t word_length() const {
    constexpr std::size_t longest = 100;
    std::size_t length = 1;
    while (is_letter(sign(length)) || is_digit(sign(length))) ++length;
    if (length > longest)
      refuse(line_, text_.substr(at_, length),
             fmt::format("is too long; accepted: up to {} letters", longest));
    return length;
  }
  std::size_t digits(std::size_t from) const {
    std::size_t count = 0;
    while (is_digit(sign(from + count))) ++count;
    return count;
  }
  std::size_t number_length() const {
    constexpr std::size_t longest = 100;
    const std::size_t length = unbounded_number_length();
    if (length > longest)
      refuse(line_, text_.substr(at_, 10),
             fmt::format("is too long a number; accepted: up to {} signs", longest));
    return length;
  }
  std::size_t unbounded_number_length() const {
    std::size_t length = digits(0);
    if (sign(length) == '.') length += 1 + digits(length + 1);
    if (sign(length) != 'e' && sign(length) != 'E') return length;
    const std::size_t power = sign(length + 1) == '+' || sign(length + 1) == '-' ? 2 : 1;
    const std::size_t count = digits(length + power);
    return count == 0 ? length : length + power + count;  // without digits the letter begins a word
  }

  std::string_view text_;
  std::size_t at_ = 0, line_start_ = 0;
  int line_ = 1;
};

char closing_of(char opening) {
  if (opening == '(') return ')';
  return opening == '[' ? ']' : '}';
}

/// Finds the pairs of brackets, and where statements begin: outside of all brackets, behind `;` or
/// a closed bracket.
void find_structure(std::vector<Token>& tokens) {
  std::vector<std::size_t> open;
  bool begins = true;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    Token& token = tokens[i];
    token.first = begins && open.empty();
    if (token.is("(") || token.is("[") || token.is("{")) {
      open.push_back(i);
    } else if (token.is(")") || token.is("]") || token.is("}")) {
      if (open.empty() || closing_of(tokens[open.back()].text[0]) != token.text[0])
        refuse(token.line, token.text, "closes no bracket; accepted: brackets in pairs");
      token.partner = open.back();
      tokens[open.back()].partner = i;
      open.pop_back();
    }
    begins = token.is(";") || token.is("}") || token.is(")") || token.is("EndFor");
  }
  if (!open.empty())
    refuse(tokens[open.back()].line, tokens[open.back()].text,
           "is never closed; accepted: brackets in pairs");
}

/// Writes the script anew, token by token.
class Rewriter {
 public:
  explicit Rewriter(const std::vector<Token>& tokens) : tokens_(tokens) {
    find_variables();
    find_numbers();
  }

  std::string script() {
    std::vector<int> loops;  // the lines of those that are open
    for (std::size_t i = 0; i < tokens_.size();) {
      const Token& token = tokens_[i];
      if (!token.first || !token.is_word() || variables_.contains(token.text)) {
        i = copy(i);
      } else if (mesh_alone.contains(token.text)) {
        i = behind_what_meshes(i);
      } else if (token.is("DefineConstant")) {
        i = constants(i);
      } else if (token.is("SetFactory")) {
        i = factory(i);
      } else if (token.is("Geometry")) {
        i = option(i);
      } else if (token.is("For") || token.is("EndFor")) {
        if (token.is("EndFor") && loops.empty())
          refuse(token.line, "EndFor", "ends no loop; accepted: one for each For");
        if (token.is("For"))
          loops.push_back(token.line);
        else
          loops.pop_back();
        nothing_behind(token.is("For") ? end_of_header(i) : i, token);
        put(i++, token.text);
      } else {
        i = copy(i);
      }
    }
    if (!loops.empty())
      refuse(loops.back(), "For", "is never ended; accepted: a loop with its EndFor");
    return script_ + "\n";
  }

 private:
  using Kind = Token::Kind;
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  bool is(std::size_t i, std::string_view wanted) const {
    return i < tokens_.size() && tokens_[i].is(wanted);
  }
  bool is_word(std::size_t i) const { return i < tokens_.size() && tokens_[i].is_word(); }
  void expect(std::size_t i, std::string_view wanted, std::size_t statement) const {
    if (!is(i, wanted))
      refuse(tokens_[statement].line, tokens_[statement].text,
             fmt::format("accepted: a {} in it here", wanted));
  }

  /// The closed bracket of For (...) or For name In {...}.
  std::size_t end_of_header(std::size_t i) const {
    const std::size_t bracket = is(i + 1, "(") ? i + 1 : i + 3;
    if (!is(i + 1, "(") && (!is_word(i + 1) || !is(i + 2, "In") || !is(i + 3, "{")))
      refuse(tokens_[i].line, "For", "accepted: For name In {...} or For (...)");
    return tokens_[bracket].partner;
  }

  /// gmsh reads line by line, and a loop returns to the line behind its header: statements on the
  /// header's line are run once, and those behind EndFor each time. A comment there that does not
  /// end with the line is read only once, or together with the beginning of the loop.
  void nothing_behind(std::size_t last, const Token& word) const {
    if (tokens_[last].open_line)
      refuse(tokens_[last].line, word.text,
             "accepted: no comment behind it that goes on beyond the line");
    if (last + 1 < tokens_.size() && tokens_[last + 1].line == tokens_[last].line)
      refuse(tokens_[last].line, word.text, "accepted: a new line behind it");
  }

  /// The `;` that ends the statement.
  std::size_t end_of(std::size_t statement) const {
    std::size_t i = statement;
    while (i < tokens_.size() && !is(i, ";")) i = std::max(i, tokens_[i].partner) + 1;
    if (i >= tokens_.size())
      refuse(tokens_[statement].line, tokens_[statement].text, "has no end; accepted: a ;");
    return i;
  }

  /// Whether `name = `, `name += `, `name++`, `name[...] = `, `name~{...}(...) = ` stands at i. An
  /// entry of a list is a number: `name(...) = {` belongs to a command.
  bool is_assigned(std::size_t i) const {
    ++i;
    while (is(i, "~") && is(i + 1, "{")) i = tokens_[i + 1].partner + 1;
    const bool entry = (is(i, "(") || is(i, "[")) && tokens_[i].partner > i + 1;
    if (is(i, "(") || is(i, "[")) i = tokens_[i].partner + 1;
    if (entry && is(i, "=") && is(i + 1, "{")) return false;
    return i < tokens_.size() && tokens_[i].kind == Kind::sign &&
           (assignments.contains(tokens_[i].text) || tokens_[i].is("++") || tokens_[i].is("--"));
  }

  /// Variables are the names that the script assigns.
  void find_variables() {
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
      if (!tokens_[i].first || !tokens_[i].is_word()) continue;
      if (tokens_[i].is("For") && is_word(i + 1)) {
        variables_.insert(tokens_[i + 1].text);
      } else if (tokens_[i].is("DefineConstant") && is(i + 1, "[")) {
        for (std::size_t k = i + 2; k < tokens_[i + 1].partner;
             k = std::max(k, tokens_[k].partner) + 1)
          if (is_word(k) && !tokens_[k - 1].is("=")) variables_.insert(tokens_[k].text);
      } else if (is_assigned(i)) {
        variables_.insert(tokens_[i].text);
      }
    }
    variables_.erase("newcl");
    for (const Words* known : {&commands, &named_commands, &openings, &mesh_alone})
      for (const std::string& word : *known) variables_.erase(word);
  }

  /// Where Physical statements begin to count, and the variables that are numbers of fields.
  void find_numbers() {
    std::vector<std::size_t> loops;
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
      if (!tokens_[i].first) continue;
      if (is(i, "For")) loops.push_back(i);
      if (is(i, "EndFor") && !loops.empty()) loops.pop_back();
      if (is(i, "Physical") && first_physical_ == none)
        first_physical_ = loops.empty() ? i : loops.front();
      if (is_field_number(i)) field_numbers_.insert(tokens_[i].text);
    }
  }
  /// Whether `name = newf;` begins at i.
  bool is_field_number(std::size_t i) const {
    return tokens_[i].first && is_word(i) && is(i + 1, "=") && is(i + 2, "newf") && is(i + 3, ";");
  }
  /// Physical groups and fields are left out, so that numbers that count them would be others.
  void refuse_other_numbers(std::size_t i) const {
    const Token& token = tokens_[i];
    if (first_physical_ < i && counted_numbers.contains(token.text))
      refuse(token.line, token.text,
             "numbers shapes by the Physical groups before it, which are left out; accepted: "
             "Physical behind all shapes");
    if (token.is("newf") && (i < 2 || !is_field_number(i - 2)))
      refuse(token.line, "newf",
             "counts fields, which are left out; accepted: NAME = newf; for a Field[NAME]");
    if (token.is_word() && field_numbers_.contains(token.text) && !is_field_number(i))
      refuse(token.line, token.text,
             "is the number of a field, and fields are left out; accepted: another name for "
             "what is drawn");
  }

  /// Writes `text` on the line that token i has in the file. gmsh reads a longer line in parts, and
  /// the end of a loop may return to a place between two of them, in the middle of a word: long
  /// lines are broken.
  void put(std::size_t i, std::string_view text) {
    constexpr std::size_t longest = 2000;  // a part has 8192 signs
    if (line_ == tokens_[i].line && script_.size() > line_start_ + longest) new_line();
    for (; line_ < tokens_[i].line; ++line_) new_line();
    script_ += ' ';
    script_ += text;
  }
  void new_line() {
    script_ += '\n';
    line_start_ = script_.size();
  }

  /// Marks the brackets of an index behind a variable whose last token is i. gmsh compares an index
  /// with the length of the list alone, so that a negative one reads and writes memory before it.
  /// Round(1/(1/Max(0, m))) is m for m = 1, 2, ..., and a division by zero, which gmsh reports, for
  /// other numbers. With m = n + 1, and with 1e6 + 1 - n, it reports an index n outside of 0 to
  /// 1e6. The outer Min and Max keep it inside whatever a failed division leaves.
  void guard_index(std::size_t i) {
    if ((!is(i + 1, "[") && !is(i + 1, "(")) || tokens_[i + 1].partner == i + 2) return;
    if (is(i + 2, "{"))
      refuse(tokens_[i + 1].line, tokens_[i].text,
             "a list of indices is not accepted; accepted: one index");
    guarded_.insert({i + 1, tokens_[i + 1].partner});
  }

  /// Copies token i; the next one. Throws Error where it is not accepted.
  std::size_t copy(std::size_t i) {
    const Token& token = tokens_[i];
    refuse_other_numbers(i);
    if (token.kind == Kind::text)
      refuse(token.line, token.text, "a text is not accepted here; " + std::string(accepted));
    if (token.kind == Kind::sign) {
      if (!signs.contains(token.text))
        refuse(token.line, token.text, "this sign is not accepted here; " + std::string(accepted));
      copy_sign(i);
    } else if (token.kind == Kind::number || commands.contains(token.text)) {
      put(i, token.text);
    } else if (named_commands.contains(token.text)) {
      named_command(i);
    } else if (token.is("newcl")) {
      put(i, "newll");  // the same number; gmsh 4.8 knows newll alone
    } else if (variables_.contains(token.text)) {
      put(i, variable(token.text));
      guard_index(i);
    } else {
      const bool member = is(i + 1, ".") && is_word(i + 2);
      refuse(
          token.line, member ? token.text + "." + tokens_[i + 2].text : token.text,
          "is neither a command that draws nor a variable of the script; " + std::string(accepted));
    }
    return i + 1;
  }
  /// v_1, v_2, ... in the order in which the script names them. gmsh looks for the end of a loop
  /// that it skips letter by letter, inside of names, too: a name of the script would take part in
  /// it. To gmsh x~{1} is x_1, so that numbers behind the name are kept.
  std::string variable(const std::string& name) {
    std::size_t end = name.size();
    for (std::size_t at = end; at > 0;) {
      while (at > 0 && is_digit(name[at - 1])) --at;
      if (at == end || at < 2 || name[at - 1] != '_') break;
      end = --at;
    }
    const int number =
        numbers_.try_emplace(name.substr(0, end), static_cast<int>(numbers_.size()) + 1)
            .first->second;
    return fmt::format("v_{}{}", number, name.substr(end));
  }
  /// name~{...}~{...}: gmsh writes a name that it does not know into a text of 1,024 letters.
  void refuse_long_chains(std::size_t i) const {
    constexpr int longest = 8;  // of up to 12 letters each
    int links = 0;
    for (std::size_t at = i; is(at, "~") && is(at + 1, "{"); at = tokens_[at + 1].partner + 1)
      ++links;
    if (links > longest)
      refuse(tokens_[i].line, "~",
             fmt::format("stands {} times in a row; accepted: up to {}", links, longest));
  }
  /// Line Loop(...), Curve Loop(...), Wire Loop(...), Surface Loop(...); the others before a {.
  void named_command(std::size_t i) {
    const Token& token = tokens_[i];
    const bool loop = token.is("Loop");
    const bool behind_its_kind = i > 0 && (is(i - 1, "Line") || is(i - 1, "Curve") ||
                                           is(i - 1, "Wire") || is(i - 1, "Surface"));
    const bool is_in_place = loop ? behind_its_kind && is(i + 1, "(") : is(i + 1, "{");
    if (!is_in_place)
      refuse(token.line, token.text,
             loop ? "is no variable; accepted: Line Loop(...), Curve Loop(...), Surface Loop(...)"
                  : "is no variable; accepted: " + token.text + " { ... }");
    put(i, token.text);
  }
  void copy_sign(std::size_t i) {
    const Token& token = tokens_[i];
    if (token.is("~")) refuse_long_chains(i);
    const bool closes = token.is(")") || token.is("]") || token.is("}");
    const bool guarded = guarded_.contains(i);
    if (guarded && closes) put(i, ") ) ) ) ) ) ) ) )");
    put(i, token.text);
    if (guarded && !closes) {
      put(i, "Min ( 1e6 , Max ( 0 , 1e6 + 1 - Round ( 1 / ( 1 / Max ( 0 , 1e6 + 2 -");
      put(i, "Round ( 1 / ( 1 / Max ( 0 , 1 + Floor (");
    }
    if (closes && token.partner > 1 && is(token.partner - 1, "~"))
      guard_index(i);  // name~{...}[...]
  }
  void copy_all(std::size_t from, std::size_t to) {
    while (from < to) from = copy(from);
  }

  /// Throws Error where tokens that are left out would change the drawing or a variable.
  void refuse_effects(std::size_t statement, std::size_t from, std::size_t to) const {
    std::size_t depth_end = from;  // behind the brackets that are open
    for (std::size_t i = from; i < to; ++i) {
      const Token& token = tokens_[i];
      const bool inside = i < depth_end;
      depth_end = std::max(depth_end, token.partner);
      const bool choice = is(statement, "DefineConstant") && token.is("=");  // {1 = "a", ...}
      if (token.is("++") || token.is("--") ||
          (token.kind == Kind::sign && assignments.contains(token.text) && inside && !choice))
        refuse(token.line, token.text,
               "changes a variable in a statement that is left out; accepted: numbers, "
               "variables, shapes and lists in " +
                   tokens_[statement].text);
      if (!token.is_word() || is(i - 1, ".") || without_effect.contains(token.text) ||
          variables_.contains(token.text) || is_periodic_map(statement, i))
        continue;
      if (is(i - 1, "=") && is(i - 2, "]") && is(statement, "Field")) continue;  // its kind
      refuse(token.line, token.text,
             "is in a statement that is left out; accepted: numbers, variables, shapes and "
             "lists in " +
                 tokens_[statement].text);
    }
  }
  /// Periodic ... = ... Translate {...}; maps meshes, and moves nothing.
  bool is_periodic_map(std::size_t statement, std::size_t i) const {
    return is(statement, "Periodic") && is(i + 1, "{") && is(tokens_[i + 1].partner + 1, ";") &&
           (is(i, "Translate") || is(i, "Rotate") || is(i, "Affine"));
  }

  /// Leaves out a statement that concerns the mesh alone.
  std::size_t behind_what_meshes(std::size_t statement) const {
    const std::size_t end = end_of(statement);
    refuse_effects(statement, statement + 1, end);
    for (std::size_t i = statement; i < end; ++i)
      if (is(statement, "Printf") && (is(i, ">") || is(i, ">>")))
        refuse(tokens_[i].line, "Printf", "writes a file; accepted: Printf without > and >>");
    if (!is(statement, "Field") || !is(statement + 1, "[")) return end + 1;
    const std::size_t behind = tokens_[statement + 1].partner + 1;
    if (is(behind, "=") && (!is_word(behind + 1) || !fields.contains(tokens_[behind + 1].text)))
      refuse(tokens_[statement].line, "Field = " + tokens_[behind + 1].text,
             fmt::format("is no field that is known to read no file; accepted: {}",
                         fmt::join(fields, ", ")));
    return end + 1;
  }

  /// DefineConstant[ name = value, name = {value, Name "...", ...}, ... ]; of an entry its value is
  /// kept.
  std::size_t constants(std::size_t statement) {
    const std::size_t end = end_of(statement);
    expect(statement + 1, "[", statement);
    const std::size_t last = tokens_[statement + 1].partner;
    if (last + 1 != end)
      refuse(tokens_[statement].line, "DefineConstant", "accepted: DefineConstant[...];");
    put(statement, "DefineConstant");
    put(statement + 1, "[");
    for (std::size_t i = statement + 2; i < last;) {
      if (!is(i, "{") || !is(i - 1, "=")) {
        i = copy(i);
        continue;
      }
      const std::size_t closing = tokens_[i].partner;
      std::size_t comma = i + 1;
      while (comma < closing && !is(comma, ","))
        comma = std::max(comma, tokens_[comma].partner) + 1;
      copy_all(i, comma);
      refuse_effects(statement, comma, closing);
      refuse_shared_names(comma, closing);
      i = copy(closing);
    }
    put(last, "]");
    put(end, ";");
    return end + 1;
  }

  /// Constants of the same Name are one to gmsh: the second has the value of the first.
  void refuse_shared_names(std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      if (!is(i, "Name")) continue;
      const Token& name = tokens_[i + 1];
      if (name.kind != Kind::text)
        refuse(name.line, "Name", "accepted: a text in quotation marks behind it");
      if (!names_.insert(name.text.substr(1, name.text.size() - 2)).second)
        refuse(name.line, name.text, "names two constants; accepted: a Name for each");
    }
  }

  /// SetFactory("OpenCASCADE"); or ("Built-in").
  std::size_t factory(std::size_t i) {
    expect(i + 1, "(", i);
    expect(i + 3, ")", i);
    expect(i + 4, ";", i);
    const Token& name = tokens_[i + 2];
    const std::string known =
        name.kind == Kind::text ? name.text.substr(1, name.text.size() - 2) : "";
    if (known != "OpenCASCADE" && known != "Built-in")
      refuse(name.line, name.text,
             "is no kernel; accepted: SetFactory(\"OpenCASCADE\"), SetFactory(\"Built-in\")");
    put(i, "SetFactory ( \"" + known + "\" ) ;");
    return i + 5;
  }

  /// Geometry.NAME = expression;
  std::size_t option(std::size_t i) {
    expect(i + 1, ".", i);
    if (!is_word(i + 2) || !geometry_options.contains(tokens_[i + 2].text))
      refuse(tokens_[i].line, "Geometry." + (i + 2 < tokens_.size() ? tokens_[i + 2].text : ""),
             fmt::format("is no option that is accepted; accepted: {}",
                         fmt::join(geometry_options, ", ")));
    put(i, "Geometry . " + tokens_[i + 2].text);
    return i + 3;
  }

  const std::vector<Token>& tokens_;
  Words variables_;
  std::map<std::string, int> numbers_;  // of the variables that were written
  Words field_numbers_;
  Words names_;  // texts behind Name
  std::size_t first_physical_ = none;
  std::set<std::size_t> guarded_;  // the brackets of indices
  std::string script_;
  int line_ = 1;  // of the file
  std::size_t line_start_ = 0;
};

}  // namespace

std::vector<std::string> geometry_script_commands() {
  std::vector<std::string> all(commands.begin(), commands.end());
  all.insert(all.end(), named_commands.begin(), named_commands.end());
  all.insert(all.end(), openings.begin(), openings.end());
  all.emplace_back("newcl");
  return all;
}

std::vector<std::string> geometry_script_options() {
  return {geometry_options.begin(), geometry_options.end()};
}

std::string geometry_script(const std::string& text) {
  std::vector<Token> tokens = Scanner(text).tokens();
  find_structure(tokens);
  return Rewriter(tokens).script();
}

}  // namespace antilock
