#include "core/gl/self_check.h"

#include <vector>

#include "core/base/error.h"
#include "core/gl/program.h"
#include "core/gl/readback.h"

namespace hybridrt::gl {
namespace {

constexpr int kSide_px = 16, kTile_px = 8;
constexpr GLuint kFirstId = 0xC0FFEE00u, kNothing = 0x12345678u;

// The second triangle is the nearest, and its edges keep away from the centres of pixels. The first and the third
// cover everything.
constexpr const char* kVertices = R"(#version 450 core
const vec3 corners[9] = vec3[9](
  vec3(0, 0, 0.25), vec3(40, 0, 0.25), vec3(0, 40, 0.25),
  vec3(1.25, 1.25, 0.75), vec3(13.25, 1.25, 0.75), vec3(1.25, 7.25, 0.75),
  vec3(0, 0, 0.5), vec3(40, 0, 0.5), vec3(0, 40, 0.5));
void main() {
  vec3 corner = corners[gl_VertexID];
  gl_Position = vec4(corner.x / 8 - 1, 1 - corner.y / 8, corner.z, 1);
}
)";
constexpr const char* kIds = R"(#version 450 core
layout(location = 0) out uint id;
void main() { id = 0xC0FFEE00u + uint(gl_PrimitiveID); }
)";
// Each tile of 8 x 8 is transposed through shared memory.
constexpr const char* kTranspose = R"(#version 450 core
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform usampler2D ids;
layout(binding = 0, r32ui) uniform writeonly uimage2D answer;
shared uint tile[8][8];
void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), here = ivec2(gl_LocalInvocationID.xy);
  tile[here.y][here.x] = bitfieldReverse(texelFetch(ids, pixel, 0).r) ^ uint(pixel.y * 16 + pixel.x) * 2654435761u;
  barrier();
  imageStore(answer, pixel, uvec4(tile[here.x][here.y]));
}
)";

GLuint id_at(int x_px, int y_px) {
  // Centres inside (1.25, 1.25), (13.25, 1.25), (1.25, 7.25).
  const bool nearest = x_px >= 1 && y_px >= 1 && x_px + 2 * y_px <= 14;
  return kFirstId + (nearest ? 1 : 2);
}

GLuint reversed(GLuint bits) {
  GLuint result = 0;
  for (int i = 0; i < 32; ++i) result |= (bits >> i & 1u) << (31 - i);
  return result;
}

GLuint answer_at(int x_px, int y_px) {
  const int x = x_px / kTile_px * kTile_px + y_px % kTile_px, y = y_px / kTile_px * kTile_px + x_px % kTile_px;
  return reversed(id_at(x, y)) ^ static_cast<GLuint>(y * kSide_px + x) * 2654435761u;
}

template <typename Expected>
void compare(const Functions& gl, const Texture& texture, const char* what, const Expected& expected) {
  Readback readback(gl, sizeof(GLuint) * kSide_px * kSide_px, "self-check");
  readback.start(texture, GL_RED_INTEGER, GL_UNSIGNED_INT);
  readback.wait();
  const auto* pixels = static_cast<const GLuint*>(readback.data());
  for (int y = 0; y < kSide_px; ++y)
    for (int x = 0; x < kSide_px; ++x)
      if (const GLuint found = pixels[y * kSide_px + x]; found != expected(x, y))
        throw error(ErrorKind::device, "its driver gives wrong answers: {} {:08x} instead of {:08x} at pixel {},{}",
                    what, found, expected(x, y), x, y);
}

void draw_ids(const Functions& gl, const ShaderSources& shaders, const Texture& ids) {
  const Texture depth(gl, GL_DEPTH_COMPONENT32F, kSide_px, kSide_px, "self-check depth");
  const Framebuffer framebuffer(gl, &ids, depth, "self-check");
  const Program program(gl, shaders, {"self_check.vert", "self_check.frag"});
  const VertexArray no_attributes(gl, "self-check");
  const GLuint nothing[4] = {kNothing, 0, 0, 0};
  const float infinitely_far = 0;
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
  gl.Viewport(0, 0, kSide_px, kSide_px);
  gl.ClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
  gl.Enable(GL_DEPTH_TEST);
  gl.DepthMask(GL_TRUE);
  gl.DepthFunc(GL_GREATER);
  gl.ClearNamedFramebufferuiv(framebuffer.id(), GL_COLOR, 0, nothing);
  gl.ClearNamedFramebufferfv(framebuffer.id(), GL_DEPTH, 0, &infinitely_far);
  program.use();
  gl.BindVertexArray(no_attributes.id());
  gl.DrawArrays(GL_TRIANGLES, 0, 9);
  throw_on_error(gl, "self-check, triangles");
  compare(gl, ids, "triangle id", id_at);
  gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
}

}  // namespace

void require_right_answers(const Context& context) {
  const Functions& gl = context.functions();
  const ShaderSources shaders = {
      {"self_check.vert", kVertices}, {"self_check.frag", kIds}, {"self_check.comp", kTranspose}};
  const Texture ids(gl, GL_R32UI, kSide_px, kSide_px, "self-check ids");
  draw_ids(gl, shaders, ids);

  const Texture answer(gl, GL_R32UI, kSide_px, kSide_px, "self-check answer");
  const Program program(gl, shaders, {"self_check.comp"});
  gl.BindTextureUnit(0, ids.id());
  gl.BindImageTexture(0, answer.id(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_R32UI);
  program.use();
  gl.MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  gl.DispatchCompute(kSide_px / kTile_px, kSide_px / kTile_px, 1);
  throw_on_error(gl, "self-check, compute");
  compare(gl, answer, "computed number", answer_at);
}

}  // namespace hybridrt::gl
