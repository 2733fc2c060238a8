#pragma once

#include "core/scene/material.h"

namespace hybridrt {

/// What an MTL says about how much light a material lets through, beside what Material keeps.
struct MtlOpacity {
  float dissolve = -1, transparency = -1;  ///< d and Tr as given, in [0, 1]; -1: not given
  bool has_kd = false;                     ///< Kd is given
  bool filters = false;                    ///< Tf is given and not 1 1 1
};

/// What the scene JSON says of a material.
enum class KindWish { none, glass, opaque };

/// Which of the rules below applied.
struct OpacityNote {
  bool tr_ignored = false;     ///< Tr 1 was taken as opaque
  bool illum_ignored = false;  ///< illum 4 or 9 was taken as opaque
};

/// Sets `opacity`, and `illum` where it is not taken by its word; the material is to be resolved after that.
///  - d counts where it is given; Tr alone means d = 1 - Tr.
///  - Tr 1 without d means opaque: MeshLab, openMVS and others write it so. It means clear with illum 6 or 7, with a Tf
///    other than 1 1 1, and with illum 4 or 9 where the material shows no colour of its own.
///  - illum 4 or 9 is opaque (2) where nothing else speaks of glass: opacity 1, no Tf or 1 1 1, no map_d, and a colour
///  of
///    its own (a Kd that is given and not black, or map_Kd). Maya writes every material so. 6 and 7 ask for refraction
///    by name and stay glass.
///  - A wish goes before all of these: opaque is d 1 and no glass; glass is illum 4 where it is none of the four.
OpacityNote settle_opacity(Material& material, const MtlOpacity& given, KindWish wish);

}  // namespace hybridrt
