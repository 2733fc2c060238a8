#pragma once

#include "core/base/parallel.h"
#include "core/base/warnings.h"
#include "core/load/load_watch.h"
#include "core/scene/scene.h"

namespace hybridrt {

/// Reads the textures that the materials of the scene's triangles name, with watch.textures, and fills
/// scene.textures, Material::texture_maps and scene.files. `textures` holds the texture coordinates; its
/// triangle_texcoords may hold kNoIndex: such corners are at (0, 0), with a warning. Without any texture nothing is
/// kept.
///
///  - A map_Kd that is missing or cannot be read becomes a checker; other maps are then left out. One warning counts
///    those that cannot be read. A missing file has had its warning when the MTL was read.
///  - One that is damaged (TexelImage::damage) is used as it was read; one warning counts those.
///  - An alpha of 0 in every texel counts as opaque, with a warning.
///  - Holes come from map_d, else from the alpha of map_Kd, if any of its texels is under one half. map_d takes the
///    image's alpha, if it has any, else its brightness.
///  - A file is read once. All textures together may take kMostTextureWords and a quarter of watch.most_bytes, and
///  those
///    that are being decoded another quarter; those beyond count as unreadable, by their headers. The same for any
///    number of threads.
void load_textures(Scene& scene, Textures&& textures, ThreadPool& pool, Warnings& warnings, const LoadWatch& watch);

}  // namespace hybridrt
