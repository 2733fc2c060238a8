#include "core/load/loading_bytes.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/load/mesh_io.h"
#include "tests/support/load_scene.h"
#include "tests/support/temporary_folder.h"

namespace hybridrt {
namespace {

std::string ply_with(size_t vertices, size_t faces) {
  std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(vertices) +
                     "\nproperty float x\nproperty float y\nproperty float z\nelement face " + std::to_string(faces) +
                     "\nproperty list uchar int vertex_indices\nend_header\n";
  for (size_t i = 0; i < vertices; ++i) text += std::to_string(i) + (i % 2 ? " 1 0\n" : " 0 0\n");
  for (size_t i = 0; i < faces; ++i) text += "3 0 1 2\n";
  return text;
}

std::string off_with(size_t vertices, size_t faces) {
  const std::string ply = ply_with(vertices, faces);
  return "OFF # made\n# by hand\n" + std::to_string(vertices) + " " + std::to_string(faces) + " 0\n" +
         ply.substr(ply.find("end_header\n") + 11);
}

TEST(LoadingBytes, FollowTheCountsOfTheHeader) {
  const TemporaryFolder folder;
  const uint64_t small = loading_bytes(folder.write("a.ply", ply_with(300, 100)));
  EXPECT_GT(small, 300u * (24 + 12)) << "positions in double and float at least";
  EXPECT_EQ(loading_bytes(folder.write("b.ply", ply_with(3000, 1000))), 10 * small);
  EXPECT_EQ(loading_bytes(folder.write("a.off", off_with(300, 100))), small) << "the same mesh";

  std::string stl(84, '\0');
  stl[80] = 100;
  stl.append(100 * 50, '\0');
  EXPECT_EQ(loading_bytes(folder.write("a.stl", stl)), small) << "a hundred facets have three hundred vertices";
  EXPECT_EQ(loading_bytes(folder.write("a.obj", std::string(3000, '\n'))),
            2 * loading_bytes(folder.write("b.obj", std::string(1500, '\n'))));
}

TEST(LoadingBytes, BelieveNoPromiseThatTheFileHasNoRoomFor) {
  const TemporaryFolder folder;
  EXPECT_EQ(loading_bytes(folder.write("a.ply",
                                       "ply\nformat ascii 1.0\nelement vertex 4000000000\n"
                                       "property float x\nend_header\n1\n")),
            0u);
  EXPECT_LT(loading_bytes(folder.write("a.off", "OFF\n4000000000 4000000000 0\n0 0 0\n")), 10'000u);
  EXPECT_EQ(loading_bytes(folder.path / "none.obj"), 0u);
  EXPECT_EQ(loading_bytes(folder.path), 0u);
}

/// The message of load_scene with `most_bytes` allowed, or "" if it loads.
std::string refusal(const std::string& scene, uint64_t most_bytes) {
  ThreadPool pool(1);
  Warnings warnings;
  try {
    load_scene(scene, pool, warnings, std::nullopt, {most_bytes});
    return "";
  } catch (const Error& refused) {
    EXPECT_EQ(refused.kind(), ErrorKind::input);
    return refused.what();
  }
}

TEST(LoadingBytes, LimitWhatIsLoaded) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.write("a.ply", ply_with(300, 100));
  const uint64_t needed = loading_bytes(path);
  EXPECT_EQ(refusal(path, needed), "");
  EXPECT_NE(refusal(path, needed - 1).find("--max-memory"), std::string::npos);
  const std::string twice = folder.write("twice.json", R"({"meshes": ["a.ply", "a.ply"]})").string();
  EXPECT_EQ(refusal(twice, 2 * needed), "");
  EXPECT_NE(refusal(twice, 2 * needed - 1).find("a.ply and the other meshes"), std::string::npos);
  EXPECT_EQ(refusal("scene:spheres,triangles=1000", 1 << 20), "");
  EXPECT_NE(refusal("scene:spheres,triangles=20000000", 1 << 20), "");
}

}  // namespace
}  // namespace hybridrt
