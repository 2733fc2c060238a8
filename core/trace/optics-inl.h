// The surface that a ray meets and the rays that it sends on: one text for single numbers, in both precisions
// (surface.h), and for vectors of floats (surface_lanes-inl.h). Included inside their namespaces, after
// shaders/surface.glsl, with the names that it needs and Mask and HRT_ANY(condition), which is false where no number
// needs what follows.

struct MetSurface {
  Vec3 point;
  Vec3 side;          // unit geometric normal, turned toward the ray's origin
  Vec3 normal;        // unit shading normal, turned to `side`
  Real offset;        // how far off the surface new rays must start
  Mask from_outside;  // the ray met the front (counter-clockwise) side
};

HRT_FN Real largest_part(Vec3 w) { return max(max(abs(w.x), abs(w.y)), abs(w.z)); }

// The surface at weights (1 - u - v, u, v) of a triangle with corners p and normals n, met by a ray along `dir`.
HRT_FN MetSurface met_surface(Vec3 p0, Vec3 p1, Vec3 p2, Vec3 n0, Vec3 n1, Vec3 n2, Real u, Real v, Vec3 dir,
                              Real relative_offset) {
  Vec3 e1 = p1 - p0, e2 = p2 - p0;
  Vec3 unnormalized = cross(e1, e2);
  Vec3 interpolated = (Real(1) - u - v) * n0 + u * n1 + v * n2;
  Vec3 point = p0 + u * e1 + v * e2;
  Vec3 side = turned_toward(normalized_or(unnormalized, -dir), -dir);
  Vec3 normal = turned_toward(normalized_or(interpolated, side), side);
  Real offset = relative_offset * max(max(largest_part(point), largest_part(e1)), largest_part(e2));
  return {point, side, normal, offset, dot(unnormalized, dir) <= Real(0)};
}

// Where a ray along `dir` (unit) starts that leaves a surface on the side of `side`: at its offset from the surface, on
// the line through the point along `dir`, so that the offset does not change what it meets; at grazing angles, where
// that would be far along, less so.
HRT_FN Vec3 leaving_origin(Vec3 point, Vec3 side, Real offset, Vec3 dir) {
  Real cosine = dot(dir, side);
  return point + offset * (side + (dir - cosine * side) / max(cosine, Real(0.25)));
}

// Share of unpolarised light that a boundary reflects. `eta` = index on the ray's side / index beyond; `cos_in`,
// `cos_out` >= 0. Fresnel's equations.
HRT_FN Real fresnel_dielectric(Real cos_in, Real cos_out, Real eta) {
  Real parallel = (cos_in - eta * cos_out) / (cos_in + eta * cos_out);
  Real perpendicular = (eta * cos_in - cos_out) / (eta * cos_in + cos_out);
  return Real(0.5) * (parallel * parallel + perpendicular * perpendicular);
}

// What a material says of the rays that it sends on.
struct Optics {
  Vec3 reflect, transmit;
  Real ni;
  Mask bends_light, schlick, dielectric;
};

// The rays that a surface reflects and refracts, and how much of their light the incoming ray gets.
struct ScatteredRays {
  Vec3 reflected_dir, refracted_dir;        // unit
  Vec3 reflected_weight, refracted_weight;  // 0: no such ray
};

// `dir`: the unit direction of the incoming ray. Where an interpolated normal would send a ray under the surface, the
// geometric normal is used.
HRT_FN ScatteredRays scattered_rays(Optics material, Vec3 shading_normal, Vec3 side, Mask from_outside, Vec3 dir) {
  // `side` where the surface is seen from behind its interpolated normal
  Vec3 normal = HRT_CHOOSE(dot(dir, shading_normal) > Real(0), side, shading_normal);
  Real cos_in = min(-dot(dir, normal), Real(1));
  Vec3 reflected = reflect(dir, normal);
  reflected = HRT_CHOOSE(dot(reflected, side) <= Real(0), reflect(dir, side), reflected);
  Vec3 back = material.reflect;
  if (HRT_ANY(material.schlick)) {
    Real x = Real(1) - cos_in;
    back = HRT_CHOOSE(material.schlick, back + x * x * x * x * x * (Vec3(Real(1)) - back), back);
  }
  if (!HRT_ANY(material.bends_light)) return {reflected, dir, back, material.transmit};

  Real eta = HRT_CHOOSE(from_outside, Real(1) / material.ni, material.ni);
  Real cos_out_squared = Real(1) - eta * eta * (Real(1) - cos_in * cos_in);
  Mask passes = cos_out_squared > Real(0);
  Vec3 bent = dir, bent_back = Vec3(Real(1)), through = Vec3(Real(0));  // total internal reflection
  if (HRT_ANY(passes)) {
    Real cos_out = sqrt(cos_out_squared);
    bent = normalize(eta * dir + (eta * cos_in - cos_out) * normal);
    bent = HRT_CHOOSE(dot(bent, side) < Real(0), bent, dir);
    Real share = fresnel_dielectric(cos_in, cos_out, eta);
    Vec3 rest = (Real(1) - share) * material.transmit;
    bent_back = HRT_CHOOSE(passes, HRT_CHOOSE(material.dielectric, Vec3(share), back), bent_back);
    through = HRT_CHOOSE(passes, HRT_CHOOSE(material.dielectric, rest, material.transmit), through);
  }
  return {reflected, HRT_CHOOSE(material.bends_light, bent, dir), HRT_CHOOSE(material.bends_light, bent_back, back),
          HRT_CHOOSE(material.bends_light, through, material.transmit)};
}
