// gmsh has one state per process, and its initialisation changes the process: meshes are made from
// several threads, and the program that asks for them finds its locale, its environment and its own
// models of gmsh as they were.
#include <dlfcn.h>
#include <gmshc.h>

#include <clocale>
#include <cstdlib>
#include <thread>

#include "antilock/mesh/detail/gmsh_session.hpp"
#include "antilock/mesh/generate.hpp"
#include "support/scenes.hpp"
#include "support/temporary_folder.hpp"

namespace antilock::test::mesh_test::gmsh_in_a_process_test {

/// Calls one of gmshc.h's functions, as a program of its own does.
template <class Function, class... Arguments>
void gmsh(const char* name, Arguments... arguments) {
  void* const library = dlopen(ANTILOCK_GMSH_LIBRARY, RTLD_LAZY | RTLD_LOCAL);
  ASSERT_NE(library, nullptr);
  int failed = 0;
  reinterpret_cast<Function*>(dlsym(library, name))(arguments..., &failed);
  EXPECT_EQ(failed, 0) << name;
}

/// gmsh's own meshes, not those that an earlier program has kept.
class GmshInAProcess : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* folder = std::getenv("ANTILOCK_MESHES");
    kept_ = folder == nullptr ? "" : folder;
    ::unsetenv("ANTILOCK_MESHES");
  }
  void TearDown() override {
    if (!kept_.empty()) ::setenv("ANTILOCK_MESHES", kept_.c_str(), 1);
  }

 private:
  std::string kept_;
};

// pygmsh #520 and #317, scikit-gmsh #392: gmsh called from several threads ends the process.
TEST_F(GmshInAProcess, MakesMeshesForSeveralThreads) {
  const TriangleMesh alone = unstructured_mesh(12);
  std::vector<TriangleMesh> meshes(12);
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&meshes, t] {
      for (std::size_t i = t; i < meshes.size(); i += 4) meshes[i] = unstructured_mesh(12);
    });
  for (std::thread& thread : threads) thread.join();
  for (const TriangleMesh& mesh : meshes) {
    EXPECT_EQ(mesh.vertices, alone.vertices);
    EXPECT_EQ(mesh.triangles, alone.triangles);
  }
}

// vtk-dicom #130, meshlab #39, Rcs #5: a library that was called has changed the locale of the
// process. gmsh takes that of the environment, with C for numbers.
TEST_F(GmshInAProcess, LeavesTheLocaleAndTheEnvironment) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  ASSERT_NE(std::setlocale(LC_ALL, "C.UTF-8"), nullptr) << "every Debian has this locale";
  const std::string asked = std::setlocale(LC_ALL, nullptr);
  for (const char* path : {"", "/some/folder"}) {
    if (*path == 0)
      ::unsetenv("PYTHONPATH");
    else
      ::setenv("PYTHONPATH", path, 1);
    unstructured_mesh(2);
    EXPECT_EQ(std::setlocale(LC_ALL, nullptr), asked);
    const char* const after = std::getenv("PYTHONPATH");
    EXPECT_EQ(after == nullptr ? "" : std::string(after), path);  // gmsh adds a folder to it
  }
  ::unsetenv("PYTHONPATH");
  std::setlocale(LC_ALL, before.c_str());
}

// FLTK, with which gmsh draws its windows, writes preferences, and the end of gmsh removes
// .gmsh-tmp.
TEST_F(GmshInAProcess, ChangesNothingInTheHome) {
  const TemporaryFolder home;
  std::ofstream(home / ".gmsh-tmp") << "the user's";
  const char* const before = std::getenv("HOME");
  const std::string old = before == nullptr ? "" : before;
  ::setenv("HOME", home.path().c_str(), 1);
  for (int twice = 0; twice < 2; ++twice) {
    const GmshSession session;
    EXPECT_EQ(std::string(std::getenv("HOME")), home.path().string());
  }
  EXPECT_EQ(contents(home / ".gmsh-tmp"), "the user's");
  EXPECT_EQ(home.file_count(), 1);
  ::setenv("HOME", old.c_str(), 1);
  if (before == nullptr) ::unsetenv("HOME");
}

// The same mesh where the numbers of the process have a decimal comma; where no such locale is
// installed, as before.
TEST_F(GmshInAProcess, ReadsAndWritesNumbersWithAPoint) {
  const TriangleMesh plain = unstructured_mesh(6);
  for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.utf8"})
    if (std::setlocale(LC_ALL, name) != nullptr) break;
  const std::string asked = std::setlocale(LC_ALL, nullptr);
  EXPECT_EQ(unstructured_mesh(6).vertices, plain.vertices);
  EXPECT_EQ(std::setlocale(LC_ALL, nullptr), asked);
  std::setlocale(LC_ALL, "C");
}

// A program that uses gmsh itself keeps its model, its current model and its options.
TEST_F(GmshInAProcess, LeavesTheModelsOfItsCaller) {
#if GMSH_API_VERSION_MINOR < 9
  gmsh<decltype(gmshInitialize)>("gmshInitialize", 0, nullptr, 0);
#else
  gmsh<decltype(gmshInitialize)>("gmshInitialize", 0, nullptr, 0, 0);
#endif
  gmsh<decltype(gmshOptionSetNumber)>("gmshOptionSetNumber", "General.Terminal", 0);
  gmsh<decltype(gmshOptionSetNumber)>("gmshOptionSetNumber", "Mesh.RandomSeed", 7);
  gmsh<decltype(gmshModelAdd)>("gmshModelAdd", "mine");
  EXPECT_GT(unstructured_mesh(4).triangle_count(), 0);
  char* name = nullptr;
  gmsh<decltype(gmshModelGetCurrent)>("gmshModelGetCurrent", &name);
  ASSERT_NE(name, nullptr) << "gmsh has been ended";
  EXPECT_EQ(std::string(name), "mine");
  double seed = 0;
  gmsh<decltype(gmshOptionGetNumber)>("gmshOptionGetNumber", "Mesh.RandomSeed", &seed);
  EXPECT_EQ(seed, 7);
  gmsh<decltype(gmshFinalize)>("gmshFinalize");
}

}  // namespace antilock::test::mesh_test::gmsh_in_a_process_test
