// Shader programs: the driver's messages reach the user.

#include <set>

#include "core/base/check.h"
#include "core/gl/uniform.h"
#include "tests/gl/gl_test.h"

namespace hybridrt {
namespace {

class Programs : public GlTest {
 protected:
  std::string compile_error(const gl::ShaderSources& sources, std::initializer_list<std::string_view> files) {
    try {
      const gl::Program program(gl(), sources, files);
    } catch (const Error& failure) {
      EXPECT_EQ(failure.kind(), ErrorKind::device);
      return failure.what();
    }
    ADD_FAILURE() << "it compiled";
    return "";
  }
};

constexpr const char* kEmptyCompute = "#version 450 core\nlayout(local_size_x = 1) in;\nvoid main() {}\n";

TEST_F(Programs, CompilerLogIsPartOfTheError) {
  const std::string broken = "#version 450 core\nlayout(local_size_x = 1) in;\n\nvoid main() { no_such_name = 1; }\n";
  const std::string message = compile_error({{"broken.comp", broken}}, {"broken.comp"});
  EXPECT_NE(message.find("broken.comp"), std::string::npos) << message;
  EXPECT_NE(message.find("no_such_name"), std::string::npos) << message;
  EXPECT_NE(message.find('4'), std::string::npos) << "the line is missing: " << message;
}

// Errors are one line for the user, whatever the driver's log looks like.
TEST_F(Programs, ErrorsAreOneLine) {
  const std::string broken =
      "#version 450 core\nlayout(local_size_x = 1) in;\nvoid main() { first = 1; second = 2; }\n";
  const std::string message = compile_error({{"broken.comp", broken}}, {"broken.comp"});
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

TEST_F(Programs, LinkerLogIsPartOfTheError) {
  const gl::ShaderSources sources = {
      {"a.vert", "#version 450 core\nout vec3 c;\nvoid main() { c = vec3(0); gl_Position = vec4(0); }\n"},
      {"a.frag", "#version 450 core\nin vec4 c;\nout vec4 o;\nvoid main() { o = c; }\n"}};
  const std::string message = compile_error(sources, {"a.vert", "a.frag"});
  EXPECT_NE(message.find("a.vert"), std::string::npos) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

TEST_F(Programs, MissingFilesAreNamed) {
  EXPECT_NE(compile_error({}, {"gone.comp"}).find("gone.comp"), std::string::npos);
  const gl::ShaderSources includes_nothing = {{"a.comp", "#version 450 core\n#include \"gone.glsl\"\n"}};
  EXPECT_NE(compile_error(includes_nothing, {"a.comp"}).find("gone.glsl"), std::string::npos);
}

/// Functions that count the live shaders and programs of a context.
struct CountedObjects {
  explicit CountedObjects(const gl::Functions& gl) : counting(gl) {
    real = &gl;
    live.clear();
    made = 0;
    counting.CreateShader = [](GLenum stage) { return add(real->CreateShader(stage)); };
    counting.CreateProgram = [] { return add(real->CreateProgram()); };
    counting.DeleteShader = [](GLuint id) { live.erase(id), real->DeleteShader(id); };
    counting.DeleteProgram = [](GLuint id) { live.erase(id), real->DeleteProgram(id); };
  }
  static GLuint add(GLuint id) {
    live.insert(id);
    ++made;
    return id;
  }

  gl::Functions counting;
  // Static, since GL's functions take no user pointer. Shaders and programs share their names.
  static inline const gl::Functions* real;
  static inline std::set<GLuint> live;
  static inline int made;
};

TEST_F(Programs, LeaveNoObjectBehind) {
  const CountedObjects objects(gl());
  const std::string vertex = "#version 450 core\nout vec3 c;\nvoid main() { c = vec3(0); gl_Position = vec4(0); }\n";
  const auto fails_with = [&](const std::string& fragment, int objects_made) {
    objects.made = 0;
    const gl::ShaderSources sources = {{"a.vert", vertex}, {"a.frag", fragment}};
    EXPECT_THROW(gl::Program(objects.counting, sources, {"a.vert", "a.frag"}), Error) << fragment;
    EXPECT_EQ(objects.made, objects_made) << fragment;
    EXPECT_TRUE(objects.live.empty()) << fragment;
  };
  fails_with("#version 450 core\n#include \"gone.glsl\"\n", 2);
  fails_with("#version 450 core\nvoid main() { no_such_name = 1; }\n", 3);
  fails_with("#version 450 core\nin vec4 c;\nout vec4 o;\nvoid main() { o = c; }\n", 3);  // does not link

  {
    const gl::Program program(objects.counting, {{"empty.comp", kEmptyCompute}}, {"empty.comp"});
    EXPECT_EQ(objects.live.size(), 1u) << "the shader belongs to the program now";
  }
  EXPECT_TRUE(objects.live.empty());
}

TEST_F(Programs, UnusedUniformIsOurMistake) {
  const gl::Program program(gl(), {{"empty.comp", kEmptyCompute}}, {"empty.comp"});
  EXPECT_THROW(gl::Uniform<int>(program, "missing"), CheckFailed);
}

TEST(Includes, AreExpandedOnceAndKeepLineNumbers) {
  const gl::ShaderSources sources = {{"a.glsl", "A\n#include \"b.glsl\"\nlast\n"},
                                     {"b.glsl", "B\n"},
                                     {"c.comp", "#include \"a.glsl\"\n#include \"b.glsl\"\nend\n"}};
  const std::string text = gl::expand_includes(sources, "c.comp");
  EXPECT_EQ(text.find("B\n"), text.rfind("B\n")) << text;
  EXPECT_LT(text.find("A\n"), text.find("B\n"));
  EXPECT_LT(text.find("B\n"), text.find("last\n"));
  EXPECT_NE(text.find("#line 3\nend"), std::string::npos) << text;
}

TEST(EmbeddedShaders, AreTheFilesOfTheSourceTree) {
  const gl::ShaderSources embedded = gl::embedded_shaders();
  for (const auto& [name, text] : gl::load_shaders(HYBRIDRT_SHADERS))
    EXPECT_TRUE(embedded.contains(name) && embedded.at(name) == text) << name;
  EXPECT_TRUE(embedded.contains("surface.glsl"));
}

}  // namespace
}  // namespace hybridrt
