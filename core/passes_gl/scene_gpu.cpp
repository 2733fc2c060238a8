#include "core/passes_gl/scene_gpu.h"

#include <algorithm>
#include <vector>

#include "shaders/shared.h"

namespace hybridrt {
namespace {

static_assert(HRT_NO_TRIANGLE == kNoTriangle);
static_assert(sizeof(vec3) == 12 && sizeof(uvec3) == 12);

template <typename T>
gl::Buffer upload(const gl::Functions& gl, const std::vector<T>& values, const char* label) {
  return gl::Buffer(gl, values.size() * sizeof(T), values.data(), 0, label);
}

std::vector<vec4> material_texels(const Scene& scene) {
  std::vector<vec4> texels;
  for (const Material& m : scene.materials) {
    texels.push_back(vec4(m.kd, m.ns));
    texels.push_back(vec4(m.ks, m.opacity));
    texels.push_back(vec4(m.ke, static_cast<float>(m.texture_maps)));
  }
  static_assert(HRT_MATERIAL_TEXELS == 3);
  return texels;
}

void require_fit(const gl::Context& context, const char* what, size_t count) {
  gl::require_limit(what, static_cast<long long>(count), "GL_MAX_TEXTURE_BUFFER_SIZE",
                    context.info().max_buffer_texels);
}

constexpr int kWordsWidth = 1 << HRT_TEXTURE_WORDS_WIDTH_SHIFT;

/// Uploads blocks of whole rows, then the rest as a part of a row: drivers copy what they are given.
void upload_words(const gl::Functions& gl, const gl::Texture& texture, const std::vector<uint32_t>& words) {
  constexpr size_t kRowsTogether = 1024;
  const size_t whole_rows = words.size() / kWordsWidth, rest = words.size() % kWordsWidth;
  const auto put = [&](size_t row, int width, size_t rows) {
    gl.TextureSubImage2D(texture.id(), 0, 0, static_cast<GLint>(row), width, static_cast<GLsizei>(rows), GL_RED_INTEGER,
                         GL_UNSIGNED_INT, &words[row * kWordsWidth]);
  };
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
  for (size_t row = 0; row < whole_rows; row += kRowsTogether)
    put(row, kWordsWidth, std::min(kRowsTogether, whole_rows - row));
  if (rest > 0) put(whole_rows, static_cast<int>(rest), 1);
}

gl::Texture make_words(const gl::Context& context, const Textures& textures) {
  const size_t rows = (textures.words.size() + kWordsWidth - 1) / kWordsWidth;
  gl::require_limit("all textures", static_cast<long long>(std::max<size_t>(rows, kWordsWidth)), "GL_MAX_TEXTURE_SIZE",
                    context.info().max_texture_px);
  const gl::Functions& gl = context.functions();
  gl::Texture words(gl, GL_R32UI, kWordsWidth, static_cast<int>(rows), "texture words");
  upload_words(gl, words, textures.words);
  return words;
}

}  // namespace

TexturesGpu::TexturesGpu(const gl::Context& context, const Textures& t) : any_holes(t.any_holes) {
  require_fit(context, "a number of texture coordinates", t.texcoords.size());
  const gl::Functions& gl = context.functions();
  texcoords = upload(gl, t.texcoords, "texture coordinates");
  triangle_texcoords = upload(gl, t.triangle_texcoords, "triangle texture coordinates");
  triangle_maps = upload(gl, t.triangle_maps, "triangle maps");
  texcoords_texels = {gl, texcoords, GL_RG32F, "texture coordinates"};
  triangle_texcoords_texels = {gl, triangle_texcoords, GL_RGB32UI, "triangle texture coordinates"};
  triangle_maps_texels = {gl, triangle_maps, GL_R32UI, "triangle maps"};
  words = make_words(context, t);
  no_attributes = {gl, "corners fetched by shaders"};
  gl::throw_on_error(gl, "uploading the textures");
}

void TexturesGpu::bind(const gl::Functions& gl) const {
  gl.BindTextureUnit(HRT_UNIT_TEXCOORDS, texcoords_texels.id());
  gl.BindTextureUnit(HRT_UNIT_TRIANGLE_TEXCOORDS, triangle_texcoords_texels.id());
  gl.BindTextureUnit(HRT_UNIT_TRIANGLE_MAPS, triangle_maps_texels.id());
  gl.BindTextureUnit(HRT_UNIT_TEXTURE_WORDS, words.id());
}

ColorsGpu::ColorsGpu(const gl::Context& context, const Scene& scene) {
  require_fit(context, "a number of colours", scene.colors.size());
  const gl::Functions& gl = context.functions();
  colors = upload(gl, scene.colors, "colours");
  triangle_colors = upload(gl, scene.triangle_colors, "triangle colours");
  colors_texels = {gl, colors, GL_RGB32F, "colours"};
  triangle_colors_texels = {gl, triangle_colors, GL_RGB32UI, "triangle colours"};
}

void ColorsGpu::bind(const gl::Functions& gl) const {
  gl.BindTextureUnit(HRT_UNIT_COLORS, colors_texels.id());
  gl.BindTextureUnit(HRT_UNIT_TRIANGLE_COLORS, triangle_colors_texels.id());
}

SceneGpu::SceneGpu(const gl::Context& context, const Scene& scene) {
  require_fit(context, "a number of triangles", scene.triangle_count());
  require_fit(context, "a number of vertices", scene.positions.size());
  require_fit(context, "a number of normals", scene.normals.size());
  require_fit(context, "a number of materials", scene.materials.size() * HRT_MATERIAL_TEXELS);

  const gl::Functions& gl = context.functions();
  index_count = static_cast<int>(3 * scene.triangle_count());
  positions = upload(gl, scene.positions, "positions");
  triangle_positions = upload(gl, scene.triangle_positions, "triangle positions");
  normals = upload(gl, scene.normals, "normals");
  triangle_normals = upload(gl, scene.triangle_normals, "triangle normals");
  triangle_materials = upload(gl, scene.triangle_materials, "triangle materials");
  materials = upload(gl, material_texels(scene), "materials");
  positions_texels = {gl, positions, GL_RGB32F, "positions"};
  triangle_positions_texels = {gl, triangle_positions, GL_RGB32UI, "triangle positions"};
  normals_texels = {gl, normals, GL_RGB32F, "normals"};
  triangle_normals_texels = {gl, triangle_normals, GL_RGB32UI, "triangle normals"};
  triangle_materials_texels = {gl, triangle_materials, GL_R32UI, "triangle materials"};
  materials_texels = {gl, materials, GL_RGBA32F, "materials"};
  vertex_array = {gl, positions, triangle_positions, "scene"};
  if (scene.has_colors()) colors.emplace(context, scene);
  if (scene.textures) textures.emplace(context, *scene.textures);
  gl::throw_on_error(gl, "uploading the scene");
}

void SceneGpu::draw(const gl::Functions& gl) const {
  gl.BindVertexArray(vertex_array.id());
  gl.DrawElements(GL_TRIANGLES, index_count, GL_UNSIGNED_INT, nullptr);
}

void SceneGpu::draw_with_holes(const gl::Functions& gl) const {
  bind_geometry(gl);
  textures->bind(gl);
  gl.BindVertexArray(textures->no_attributes.id());
  gl.DrawArrays(GL_TRIANGLES, 0, index_count);
}

void SceneGpu::bind_geometry(const gl::Functions& gl) const {
  gl.BindTextureUnit(HRT_UNIT_POSITIONS, positions_texels.id());
  gl.BindTextureUnit(HRT_UNIT_TRIANGLE_POSITIONS, triangle_positions_texels.id());
}

void SceneGpu::bind_shading(const gl::Functions& gl) const {
  bind_geometry(gl);
  gl.BindTextureUnit(HRT_UNIT_NORMALS, normals_texels.id());
  gl.BindTextureUnit(HRT_UNIT_TRIANGLE_NORMALS, triangle_normals_texels.id());
  gl.BindTextureUnit(HRT_UNIT_TRIANGLE_MATERIALS, triangle_materials_texels.id());
  gl.BindTextureUnit(HRT_UNIT_MATERIALS, materials_texels.id());
  if (colors) colors->bind(gl);
  if (textures) textures->bind(gl);
}

int group_count(int size_px) { return (size_px + HRT_GROUP_PX - 1) / HRT_GROUP_PX; }

}  // namespace hybridrt
