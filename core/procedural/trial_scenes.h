#pragma once

#include "core/procedural/procedural.h"

namespace hybridrt {

// Small scenes that can be driven, each by numbers of its own, to where methods of rendering fail. About four units
// across around the origin, y up, in double precision until the last step. Their parameters, with ranges and meaning,
// stand in the tables beside them.

ProceduralScene stage_scene();    ///< a ball and a box on a plane: light, view, scale, distance, facets
ProceduralScene wires_scene();    ///< wires over a plane: thin casters
ProceduralScene slivers_scene();  ///< a sheet with long, narrow triangles
ProceduralScene sheets_scene();   ///< two sheets, one closely above the other
ProceduralScene prism_scene();    ///< glass seen around its critical angle
ProceduralScene lens_scene();     ///< a ball that hardly bends light
ProceduralScene mirrors_scene();  ///< two mirrors that face each other
ProceduralScene eye_scene();      ///< an eye next to a surface, in glass, at a corner

}  // namespace hybridrt
