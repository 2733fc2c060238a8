#include "core/procedural/chess_crowns.h"

#include <algorithm>

namespace hybridrt {
namespace {

constexpr int kMerlons = 6, kPoints = 9;
constexpr double kMerlonShare = 0.6;  // share of the circle; gaps take the rest

/// Angle of the battlements at `v` along a stretch: merlon, gap, merlon, ...
double battlement_rad(int stretch, double v) {
  const double begin = stretch % 2 == 0 ? 0 : kMerlonShare, width = stretch % 2 == 0 ? kMerlonShare : 1 - kMerlonShare;
  const double turn = (stretch / 2 + begin + v * width) / kMerlons;
  return 2 * kPi * turn;
}

dvec2 on_circle(double angle_rad) { return {std::cos(angle_rad), std::sin(angle_rad)}; }

/// The bishop's mitre, without its cut.
struct Mitre {
  ProfileSpan curve;
  double slit_height, slit_width = 0.036, slope = 0.75, half_angle_rad = 1.15;

  /// Where on the curve (0..1) the cut's lower (side = -1) or upper (1) plane meets the direction.
  double edge(double angle_rad, int side) const {
    double lo = 0.02, hi = 0.98;
    for (int i = 0; i < 60; ++i) {
      const double u = 0.5 * (lo + hi);
      const dvec2 p = curve.at(u);
      (p.y < plane(p.x * std::cos(angle_rad), side) ? lo : hi) = u;
    }
    return 0.5 * (lo + hi);
  }
  double plane(double x, int side) const { return slit_height + slope * x + 0.5 * side * slit_width; }
  dvec3 on_curve(double u, double angle_rad) const {
    const dvec2 p = curve.at(u), d = on_circle(angle_rad);
    return {p.x * d.x, p.y, p.x * d.y};
  }
  /// The bottom of the cut: a flat wall across the head.
  dvec3 deep(double angle_rad, int side) const {
    const double radius = curve.at(edge(angle_rad, side)).x * std::cos(half_angle_rad) / std::cos(angle_rad);
    const dvec2 p = radius * on_circle(angle_rad);
    return {p.x, plane(p.x, side), p.y};
  }
};

}  // namespace

std::vector<Patch> rook_patches(const Profile& outside, const Profile& inside, const Fineness& fineness) {
  Outline outline;
  outline.direction = [](int stretch, double v) { return on_circle(battlement_rad(stretch, v)); };
  outline.stretches = 2 * kMerlons;
  std::vector<Patch> patches = turned(outside, outline, fineness);
  for (Patch& patch : turned(inside, outline, fineness)) patches.push_back(std::move(patch));

  const int columns = fineness.columns(outline);
  const auto add = [&](int cells, auto at) {
    Patch patch;
    patch.columns = cells, patch.at = at;
    patches.push_back(std::move(patch));
  };
  // From corner to corner of the wall's section, given as (radius, height).
  const auto sweep = [&](int stretch, dvec2 from, dvec2 to) {
    add(columns, [=](double u, double v) {
      const dvec2 p = glm::mix(from, to, u), d = on_circle(battlement_rad(stretch, v));
      return dvec3(p.x * d.x, p.y, p.x * d.y);
    });
  };
  const auto [outer, inner, low, high] = kRookCrown;
  for (int stretch = 0; stretch < 2 * kMerlons; ++stretch) {
    if (stretch % 2 == 1) {
      sweep(stretch, {outer, low}, {inner, low});
      continue;
    }
    sweep(stretch, {outer, low}, {outer, high});
    sweep(stretch, {outer, high}, {inner, high});
    sweep(stretch, {inner, high}, {inner, low});
    for (const bool end : {false, true})
      add(1, [=, outer = outer, inner = inner, low = low, high = high](double u, double v) {
        const dvec2 d = on_circle(battlement_rad(stretch, end)) * glm::mix(outer, inner, end ? u : 1 - u);
        return dvec3(d.x, glm::mix(high, low, v), d.y);
      });
  }
  return patches;
}

std::vector<Patch> bishop_patches(const Profile& body, const Fineness& fineness) {
  const dvec2 from = body.end(), to(0.030, from.y + 0.315);
  Mitre mitre;
  mitre.curve.is_curve = true, mitre.curve.from = from, mitre.curve.to = to;
  mitre.curve.control_1 = from + dvec2(0.155, 0.06), mitre.curve.control_2 = to + dvec2(0.095, -0.10);
  mitre.slit_height = from.y + 0.115;

  // Two stretches: the cut's and the rest.
  Outline outline;
  const auto angle_rad = [half = mitre.half_angle_rad](int stretch, double v) {
    return stretch == 0 ? glm::mix(-half, half, v) : glm::mix(half, 2 * kPi - half, v);
  };
  outline.direction = [=](int stretch, double v) { return on_circle(angle_rad(stretch, v)); };
  outline.stretches = 2, outline.fewest_columns = 3;
  std::vector<Patch> patches = turned(body, outline, fineness);
  Profile top(to);
  top.ball(0.050);
  for (Patch& patch : turned(top, outline, fineness)) patches.push_back(std::move(patch));

  const int columns = fineness.columns(outline), rows = std::max(2, fineness.rows(mitre.curve) / 2);
  const auto add = [&](int patch_rows, bool pointed, auto at) {
    Patch patch;
    patch.rows = patch_rows, patch.columns = columns, patch.at = at;
    patch.point_at_v0 = patch.point_at_v1 = pointed;
    patches.push_back(std::move(patch));
  };
  for (int stretch = 0; stretch < 2; ++stretch) {
    // `share`: of the way from the edge to the end of the curve.
    const auto surface = [=](double share, double low, double v) {
      const double angle = angle_rad(stretch, v);
      return mitre.on_curve(low < 0 ? share * mitre.edge(angle, -1) : glm::mix(mitre.edge(angle, 1), 1.0, share),
                            angle);
    };
    add(rows, false, [=](double u, double v) { return surface(u, -1, v); });
    add(rows, false, [=](double u, double v) { return surface(u, 1, v); });
  }
  for (const int side : {-1, 1})
    add(1, true, [=](double u, double v) {
      const double angle = angle_rad(0, v);
      const dvec3 edge = mitre.on_curve(mitre.edge(angle, side), angle), deep = mitre.deep(angle, side);
      return side < 0 ? glm::mix(edge, deep, u) : glm::mix(deep, edge, u);
    });
  add(1, false, [=](double u, double v) {
    const double angle = angle_rad(0, v);
    return glm::mix(mitre.deep(angle, -1), mitre.deep(angle, 1), u);
  });
  add(1, false, [=](double u, double v) {
    const double angle = angle_rad(1, v);
    return glm::mix(mitre.on_curve(mitre.edge(angle, -1), angle), mitre.on_curve(mitre.edge(angle, 1), angle), u);
  });
  return patches;
}

Outline coronet() {
  Outline outline;
  outline.direction = [](int stretch, double v) { return on_circle(2 * kPi * (stretch + v) / kPoints); };
  outline.lift = [](int, double v) { return -0.055 * std::pow(std::max(0.0, 4 * v * (1 - v)), 0.8); };
  outline.stretches = kPoints;
  outline.relative_columns = 1.3;
  outline.fewest_columns = 2;
  return outline;
}

std::vector<Patch> cross_patches(double bottom, const Fineness& fineness) {
  // Arm by arm: out along its flared side, across its end, back. Corners are (along, across).
  constexpr double kWaist = 0.021, kReach = 0.083, kFlare = 0.041;
  Outline outline;
  outline.direction = [](int stretch, double v) {
    const int arm = stretch / 3, part = stretch % 3;
    dvec2 p;
    if (part == 1) {
      p = {kReach, glm::mix(-kFlare, kFlare, v)};
    } else {
      const double out = part == 0 ? v : 1 - v;
      p = {glm::mix(kWaist, kReach, out), glm::mix(kWaist, kFlare, std::pow(out, 1.4))};
      if (part == 0) p.y = -p.y;
    }
    const dvec2 axes[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    const dvec2 along = axes[arm], across(-along.y, along.x);
    return p.x * along + p.y * across;
  };
  outline.stretches = 12;
  outline.relative_columns = 0.75;
  // Front to back, with a rounded edge.
  constexpr double kThick = 0.021, kEdge = 0.007;
  Profile profile({0, -kThick});
  profile.line({0.90, -kThick}).curve({0.97, -kThick}, {1, -kThick + 0.3 * kEdge}, {1, -kThick + kEdge});
  profile.line({1, kThick - kEdge}).curve({1, kThick - 0.3 * kEdge}, {0.97, kThick}, {0.90, kThick});
  profile.line({0, kThick});
  std::vector<Patch> patches = turned(profile, outline, fineness);
  for (Patch& patch : patches)
    patch.at = [lying = std::move(patch.at), bottom](double u, double v) {
      const dvec3 p = lying(u, v);
      return dvec3(-p.y, bottom + kReach + p.x, p.z);
    };
  return patches;
}

}  // namespace hybridrt
