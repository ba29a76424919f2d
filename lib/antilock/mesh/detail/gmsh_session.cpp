#include "antilock/mesh/detail/gmsh_session.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <gmshc.h>
#include <locale.h>  // NOLINT(modernize-deprecated-headers): uselocale is POSIX's

#include <algorithm>
#include <clocale>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>

#include "antilock/core/error.hpp"
#include "antilock/mesh/geometry_script.hpp"
#include "antilock/mesh/memory_file.hpp"

namespace antilock {
namespace {

/// Resets what gmsh's reader of scripts keeps from one script to the next: the variables, which a
/// DefineConstant does not change, the kernel, and the sphere on which Sphere(1) = {centre, point};
/// puts all later points. The end of a session frees the sphere, and the reader keeps its address.
constexpr auto afresh = "Delete Variables; SetFactory(\"Built-in\"); Euclidian Coordinates; ";

/// Whether the program had loaded gmsh itself before the first session.
bool loaded_before_us = false;

/// The library, for as long as the program runs: gmsh does not bear being unloaded.
void* gmsh_library() {
  static std::string why;
  static void* const library = [] {
    loaded_before_us = dlopen(ANTILOCK_GMSH_LIBRARY, RTLD_LAZY | RTLD_NOLOAD) != nullptr;
    void* const loaded = dlopen(ANTILOCK_GMSH_LIBRARY, RTLD_LAZY | RTLD_LOCAL);
    if (loaded == nullptr) why = dlerror();
    return loaded;
  }();
  if (library == nullptr)
    throw MeshError(fmt::format(
        "mesh: gmsh cannot be loaded ({}); an unstructured or layered mesh needs it (Debian: "
        "libgmsh-dev), a structured mesh or a mesh file does not",
        why));
  return library;
}

/// gmsh's one model and its options, for one session at a time: threads wait for each other here.
std::mutex& one_session() {
  static std::mutex mutex;
  return mutex;
}

/// Numbers of this thread are read and written with a decimal point, whatever the locale of the
/// process is.
locale_t use_decimal_points() {
  static const locale_t plain = ::newlocale(LC_ALL_MASK, "C", nullptr);
  return ::uselocale(plain);
}

/// A variable of the environment, which the destructor sets back.
class Variable {
 public:
  explicit Variable(const char* name) : name_(name) {
    if (const char* value = std::getenv(name)) value_ = value;
  }
  ~Variable() {
    if (value_)
      ::setenv(name_, value_->c_str(), /*overwrite*/ 1);
    else
      ::unsetenv(name_);
  }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
  std::optional<std::string> value_;
};

/// While it exists, gmsh may do to the process what its initialisation does: it takes the locale of
/// the environment for the whole process and adds its folder to PYTHONPATH. Both are put back at
/// the end. gmsh and FLTK find no home: in it FLTK would write .fltk/fltk.org/fltk.prefs, and the
/// end of a session would remove .gmsh-tmp. FLTK 1.3 also writes /etc/fltk where it may, which only
/// root may; no option prevents it.
class Unchanged {
 public:
  Unchanged() { ::setenv("HOME", "/dev/null", /*overwrite*/ 1); }
  ~Unchanged() { std::setlocale(LC_ALL, locale_.c_str()); }
  Unchanged(const Unchanged&) = delete;
  Unchanged& operator=(const Unchanged&) = delete;

 private:
  std::string locale_ = std::setlocale(LC_ALL, nullptr);
  Variable home_{"HOME"}, python_path_{"PYTHONPATH"};
};

/// A call in a destructor: nothing is thrown where it fails.
template <class Function, class... Arguments>
void try_call(const char* name, Arguments... arguments) {
  int ignored = 0;
  reinterpret_cast<Function*>(dlsym(gmsh_library(), name))(arguments..., &ignored);
}

void free_by_gmsh(void* memory) {
  reinterpret_cast<decltype(gmshFree)*>(dlsym(gmsh_library(), "gmshFree"))(memory);
}

/// What gmsh allocated, as a vector; gmsh's own memory is freed.
template <class Number>
std::vector<Number> taken(Number* first, std::size_t count) {
  std::vector<Number> all(first, first + count);
  free_by_gmsh(first);
  return all;
}

}  // namespace

void* GmshSession::symbol(const char* name) {
  void* const found = dlsym(gmsh_library(), name);
  if (found == nullptr)
    throw MeshError(fmt::format("mesh: {} has no function {}", ANTILOCK_GMSH_LIBRARY, name));
  return found;
}

void GmshSession::check(int failed, const char* name) const {
  if (failed == 0) return;
  char* message = nullptr;
  int ignored = 0;
  reinterpret_cast<decltype(gmshLoggerGetLastError)*>(symbol("gmshLoggerGetLastError"))(&message,
                                                                                        &ignored);
  const std::string said = message == nullptr ? "" : message;
  if (message != nullptr) free_by_gmsh(message);
  throw MeshError(fmt::format("mesh: gmsh failed in {}{}{}", name, said.empty() ? "" : ": ", said));
}

GmshSession::Turn::Turn() : alone(one_session()), locale(use_decimal_points()) {}

GmshSession::Turn::~Turn() { ::uselocale(static_cast<locale_t>(locale)); }

GmshSession::GmshSession() : callers_model_(current_model()) {
  if (!callers_model_) {
    const Unchanged unchanged;
#if GMSH_API_VERSION_MINOR < 9
    call<decltype(gmshInitialize)>("gmshInitialize", 0, nullptr, /*readConfigFiles=*/0);
#else
    call<decltype(gmshInitialize)>("gmshInitialize", 0, nullptr, /*readConfigFiles=*/0, /*run=*/0);
#endif
  }
  set("General.Terminal", 0);
  set("General.NumThreads", 1);  // the mesh depends on the number of threads
  set("Mesh.RandomSeed", 1);
  set("Mesh.MeshSizeExtendFromBoundary", 1);
  call<decltype(gmshModelAdd)>("gmshModelAdd", "antilock");
}

GmshSession::~GmshSession() {
  if (!callers_model_) {
    try_call<decltype(gmshFinalize)>("gmshFinalize");  // which resets the options
    return;
  }
  try_call<decltype(gmshModelRemove)>("gmshModelRemove");
  try_call<decltype(gmshModelSetCurrent)>("gmshModelSetCurrent", callers_model_->c_str());
  for (auto option = callers_options_.rbegin(); option != callers_options_.rend(); ++option)
    try_call<decltype(gmshOptionSetNumber)>("gmshOptionSetNumber", option->first.c_str(),
                                            option->second);
}

std::optional<std::string> GmshSession::current_model() {
  gmsh_library();
  // gmsh 4.8 prints a line where it is asked before it has ever been initialised
  static bool never_initialised = !loaded_before_us;
  if (std::exchange(never_initialised, false)) return std::nullopt;
  int failed = 0;
  if (void* const initialised = dlsym(gmsh_library(), "gmshIsInitialized")) {  // since 4.10
    if (reinterpret_cast<int (*)(int*)>(initialised)(&failed) == 0) return std::nullopt;
  } else {
    constexpr double untouched = -1;  // no mesh algorithm has this number
    double algorithm = untouched;
    reinterpret_cast<decltype(gmshOptionGetNumber)*>(symbol("gmshOptionGetNumber"))(
        "Mesh.Algorithm", &algorithm, &failed);
    if (failed != 0 || algorithm == untouched) return std::nullopt;
  }
  char* name = nullptr;
  reinterpret_cast<decltype(gmshModelGetCurrent)*>(symbol("gmshModelGetCurrent"))(&name, &failed);
  if (name == nullptr) return std::nullopt;
  std::string model = name;
  free_by_gmsh(name);
  return model;
}

void GmshSession::set(const char* option, double value) {
  double before = 0;
  call<decltype(gmshOptionGetNumber)>("gmshOptionGetNumber", option, &before);
  call<decltype(gmshOptionSetNumber)>("gmshOptionSetNumber", option, value);
  callers_options_.emplace_back(option, before);
}

void GmshSession::keep_geometry_options() {
  for (const std::string& name : geometry_script_options()) {
    const std::string option = "Geometry." + name;
    int unknown = 0;  // to an older gmsh
    double before = 0;
    reinterpret_cast<decltype(gmshOptionGetNumber)*>(symbol("gmshOptionGetNumber"))(
        option.c_str(), &before, &unknown);
    if (unknown == 0) callers_options_.emplace_back(option, before);
  }
}

int GmshSession::add_point(double x, double y, double size, double z) const {
  return call<decltype(gmshModelGeoAddPoint)>("gmshModelGeoAddPoint", x, y, z, size, -1);
}

int GmshSession::add_line(int from, int to) const {
  return call<decltype(gmshModelGeoAddLine)>("gmshModelGeoAddLine", from, to, -1);
}

int GmshSession::add_surface(std::array<int, 4> lines) const {
  int loop = call<decltype(gmshModelGeoAddCurveLoop)>("gmshModelGeoAddCurveLoop", lines.data(),
                                                      lines.size(), -1, 0);
  return call<decltype(gmshModelGeoAddPlaneSurface)>("gmshModelGeoAddPlaneSurface", &loop, 1, -1);
}

void GmshSession::add_volume(std::array<int, 6> surfaces) const {
  int loop = call<decltype(gmshModelGeoAddSurfaceLoop)>("gmshModelGeoAddSurfaceLoop",
                                                        surfaces.data(), surfaces.size(), -1);
  call<decltype(gmshModelGeoAddVolume)>("gmshModelGeoAddVolume", &loop, 1, -1);
}

std::pair<Points, IndexRows> GmshSession::generate(CellKind kind) const {
  const ReferenceCell& cell = reference_cell(kind);
  call<decltype(gmshModelGeoSynchronize)>("gmshModelGeoSynchronize");
  call<decltype(gmshModelMeshGenerate)>("gmshModelMeshGenerate", cell.dimension);
  std::size_t *tags = nullptr, *elements = nullptr, *nodes = nullptr;
  double *coordinates = nullptr, *parameters = nullptr;
  std::size_t tag_count = 0, coordinate_count = 0, parameter_count = 0, element_count = 0,
              node_count = 0;
  call<decltype(gmshModelMeshGetNodes)>("gmshModelMeshGetNodes", &tags, &tag_count, &coordinates,
                                        &coordinate_count, &parameters, &parameter_count,
                                        /*dim: all*/ -1, -1, 0, 0);
  if (parameters != nullptr) free_by_gmsh(parameters);
  constexpr std::array<int, 3> types{2, 3, 4};  // gmsh's own numbers, in the order of CellKind
  call<decltype(gmshModelMeshGetElementsByType)>(
      "gmshModelMeshGetElementsByType", types[static_cast<std::size_t>(kind)], &elements,
      &element_count, &nodes, &node_count, /*tag: all*/ -1, /*task*/ 0, /*numTasks*/ 1);
  free_by_gmsh(elements);
  const std::vector<double> xyz = taken(coordinates, coordinate_count);
  const std::vector<std::size_t> corners = taken(nodes, node_count);
  std::unordered_map<std::size_t, int> number;
  for (const std::size_t tag : taken(tags, tag_count))
    number.emplace(tag, static_cast<int>(number.size()));
  std::pair<Points, IndexRows> made{Points(number.size(), cell.dimension),
                                    IndexRows(corners.size() / cell.vertices, cell.vertices)};
  for (Eigen::Index v = 0; v < made.first.rows(); ++v)
    for (int k = 0; k < cell.dimension; ++k) made.first(v, k) = xyz[3 * v + k];
  std::transform(corners.begin(), corners.end(), made.second.data(),
                 [&](std::size_t tag) { return number.at(tag); });
  return made;
}

// gmshMerge tells the kind of a file by its name and its first line, and executes NAME.opt beside a
// file NAME, whatever its kind. So it is given nothing but the checked script, in a file that has
// no folder; a .brep file goes to OpenCASCADE, which knows no other kind.
void GmshSession::read(const Geometry& geometry) {
  if (geometry.script.empty()) {
    int* shapes = nullptr;
    std::size_t count = 0;
    call<decltype(gmshModelOccImportShapes)>("gmshModelOccImportShapes", geometry.file.c_str(),
                                             &shapes, &count,
                                             /*highestDimOnly*/ 0, "brep");
    free_by_gmsh(shapes);
    if (count == 0)
      throw Error(fmt::format("{}: OpenCASCADE finds no shape in it; accepted: a .brep file",
                              geometry.file));
    call<decltype(gmshModelOccSynchronize)>("gmshModelOccSynchronize");
    return;
  }
  keep_geometry_options();
  const MemoryFile script(afresh + geometry.script + afresh + "\n");
  try {
    call<decltype(gmshMerge)>("gmshMerge", script.path().c_str());
  } catch (const MeshError& error) {
    // gmsh's scanner keeps the rest of the line at fault, and would put it before the next script:
    // it is read off here
    set("General.AbortOnError", 0);
    call<decltype(gmshMerge)>("gmshMerge", MemoryFile("\n").path().c_str());
    call<decltype(gmshMerge)>("gmshMerge", MemoryFile(std::string(afresh) + "\n").path().c_str());
    std::string what = error.what();
    if (const auto at = what.find(script.path()); at != what.npos)
      what.replace(at, script.path().size(), geometry.file);
    throw MeshError(what);
  }
}

std::vector<int> GmshSession::read_curves(const Geometry& geometry) {
  read(geometry);
  int* entities = nullptr;
  std::size_t count = 0;
  call<decltype(gmshModelGetEntities)>("gmshModelGetEntities", &entities, &count, /*dim*/ 1);
  std::vector<int> tags;
  const std::vector<int> all = taken(entities, count);  // dimension and tag
  for (std::size_t i = 1; i < all.size(); i += 2) tags.push_back(all[i]);
  return tags;
}

std::vector<double> GmshSession::nearest(int curve, std::vector<double> xyz) const {
  double *points = nullptr, *parameters = nullptr;
  std::size_t point_count = 0, parameter_count = 0;
  call<decltype(gmshModelGetClosestPoint)>("gmshModelGetClosestPoint", 1, curve, xyz.data(),
                                           xyz.size(), &points, &point_count, &parameters,
                                           &parameter_count);
  free_by_gmsh(parameters);
  return taken(points, point_count);
}

}  // namespace antilock
