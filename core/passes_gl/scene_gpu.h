#pragma once

#include <optional>

#include "core/gl/context.h"
#include "core/gl/objects.h"
#include "core/scene/scene.h"

namespace hybridrt {

/// Textures in GPU memory.
struct TexturesGpu {
  gl::Buffer texcoords, triangle_texcoords, triangle_maps;
  gl::BufferTexture texcoords_texels, triangle_texcoords_texels, triangle_maps_texels;
  gl::Texture words;  ///< as texture_words.glsl reads them
  gl::VertexArray no_attributes;
  bool any_holes = false;

  TexturesGpu(const gl::Context& context, const Textures& textures);
  void bind(const gl::Functions& gl) const;
};

/// Colours of triangles' corners in GPU memory.
struct ColorsGpu {
  gl::Buffer colors, triangle_colors;
  gl::BufferTexture colors_texels, triangle_colors_texels;

  ColorsGpu(const gl::Context& context, const Scene& scene);
  void bind(const gl::Functions& gl) const;
};

/// The scene's arrays in GPU memory, made once, then only read. Each index buffer serves drawing and, as a buffer
/// texture, lookups per pixel.
struct SceneGpu {
  /// Throws Error(device) naming the limit when the scene does not fit the device's buffer textures.
  SceneGpu(const gl::Context& context, const Scene& scene);

  int index_count = 0;
  gl::Buffer positions, triangle_positions, normals, triangle_normals, triangle_materials, materials;
  gl::BufferTexture positions_texels, triangle_positions_texels, normals_texels, triangle_normals_texels,
      triangle_materials_texels, materials_texels;
  gl::VertexArray vertex_array;
  std::optional<ColorsGpu> colors;  ///< if the scene has any
  std::optional<TexturesGpu> textures;

  bool has_holes() const { return textures && textures->any_holes; }
  /// Draws every triangle; gl_PrimitiveID is the triangle's number.
  void draw(const gl::Functions& gl) const;
  /// The same for shaders/holes_vert.glsl, which fetches corners itself.
  void draw_with_holes(const gl::Functions& gl) const;
  /// Binds what shaders/scene.glsl reads.
  void bind_geometry(const gl::Functions& gl) const;
  /// Binds normals, materials, colours and textures too.
  void bind_shading(const gl::Functions& gl) const;
};

/// Work groups that cover `size_px` pixels along one side.
int group_count(int size_px);

}  // namespace hybridrt
