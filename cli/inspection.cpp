#include "cli/inspection.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>

#include "cli/warning_output.h"
#include "core/base/shortest.h"

namespace hybridrt::cli {
namespace {

using json = nlohmann::ordered_json;

constexpr size_t kMostComponents = 100;

json array_of(const dvec3& v) { return {v.x, v.y, v.z}; }
json array_of(const vec3& v) { return {shortest_double(v.x), shortest_double(v.y), shortest_double(v.z)}; }

json materials_json(const Inspection& in) {
  json all = json::array();
  for (size_t i = 0; i < in.job.scene.materials.size(); ++i) {
    const Material& m = in.job.scene.materials[i];
    all.push_back({{"name", m.name},
                   {"kind", kind_of(m)},
                   {"illum", m.illum},
                   {"kd", array_of(m.kd)},
                   {"ks", array_of(m.ks)},
                   {"ke", array_of(m.ke)},
                   {"tf", array_of(m.tf)},
                   {"ns", shortest_double(m.ns)},
                   {"ni", shortest_double(m.ni)},
                   {"d", shortest_double(m.opacity)},
                   {"triangles", in.material_triangles[i]}});
  }
  return all;
}

json components_json(const Topology& t) {
  size_t closed = 0, closed_triangles = 0;
  for (const Component& component : t.components)
    if (component.closed()) ++closed, closed_triangles += component.triangles;
  json largest = json::array();
  for (uint32_t i : largest_components(t, kMostComponents)) {
    const Component& c = t.components[i];
    largest.push_back({{"first_triangle", c.first_triangle},
                       {"triangles", c.triangles},
                       {"closed", c.closed()},
                       {"oriented", c.oriented()},
                       {"winding", name_of(c.winding)},
                       {"volume", c.volume},
                       {"boundary_edges", c.boundary_edges},
                       {"inconsistent_edges", c.inconsistent_edges},
                       {"non_manifold_edges", c.non_manifold_edges}});
  }
  return {{"count", t.components.size()},
          {"closed", closed},
          {"open", t.components.size() - closed},
          {"closed_triangles", closed_triangles},
          {"largest", largest}};
}

json frame_json(const Inspection& in) {
  const RenderSettings& s = in.job.settings;
  const Camera camera = camera_at(in.job.motion, in.plan.number);
  json lights = json::array();
  for (const DirectionalLight& light : in.plan.lights)
    lights.push_back(
        {{"toward", array_of(light.toward)}, {"color", array_of(light.color)}, {"casts_shadow", light.casts_shadow}});
  json steps = json::array();
  for (const StepNote& note : in.steps)
    steps.push_back({{"step", note.step}, {"runs", name_of(note.runs)}, {"why", note.why}});
  return {{"number", in.plan.number},
          {"frames", in.job.frames.count()},
          {"width", s.width_px},
          {"height", s.height_px},
          {"method", name_of(s.method)},
          {"shadows", name_of(s.shadows)},
          {"passes", uses_gl(s) ? "gl" : "cpu"},
          {"passes_reason", in.job.forms_reason},
          {"eye", array_of(camera.eye_world)},
          {"target", array_of(camera.target_world)},
          {"fov_y_deg", camera.fov_y_rad * 180 / kPi},
          {"lights", lights},
          {"steps", steps}};
}

}  // namespace

json inspection_json(const Inspection& in) {
  const Scene& scene = in.job.scene;
  const Topology& t = in.job.topology;
  const dvec3 lo(scene.bounds.lo), hi(scene.bounds.hi);
  const bool limited = in.job.most_bytes < std::numeric_limits<uint64_t>::max();
  const json allowed = limited ? json(in.job.most_bytes) : json();
  return {
      {"scene", in.scene},
      {"files", scene.files},
      {"triangles", scene.triangle_count()},
      {"vertices", scene.positions.size()},
      {"normals",
       {{"given_corners", 3 * scene.triangle_count() - scene.built_normal_corners},
        {"built_corners", scene.built_normal_corners}}},
      {"textures", {{"bytes", scene.textures ? 4 * scene.textures->words.size() : 0}, {"holes", scene.has_holes()}}},
      {"colors", scene.colors.size()},
      {"bounds", {{"lo", array_of(scene.origin_world + lo)}, {"hi", array_of(scene.origin_world + hi)}}},
      {"extent", array_of(hi - lo)},
      {"origin_world", array_of(scene.origin_world)},
      {"notes", scene.notes},
      {"warnings", json_of(in.warnings)},
      {"components", components_json(t)},
      {"edges",
       {{"count", t.edge_count},
        {"boundary", t.boundary_edges},
        {"inconsistent", t.inconsistent_edges},
        {"non_manifold", t.non_manifold_edges}}},
      {"materials", materials_json(in)},
      {"memory_bytes",
       {{"scene", in.memory.scene},
        {"gpu_scene", in.memory.gpu_scene},
        {"gpu_frames", in.memory.gpu_frames},
        {"frames", in.memory.frames},
        {"pictures", in.memory.pictures},
        {"accelerator", in.memory.accelerator},
        {"topology", in.memory.topology},
        {"total", in.memory.total()},
        {"allowed", allowed}}},
      {"frame", frame_json(in)}};
}

std::string_view kind_of(const Material& m) {
  const bool glass = m.illum == 4 || m.illum == 6 || m.illum == 7 || m.illum == 9;
  if (m.transmissive()) return glass ? "glass" : "see-through";
  if (m.reflective()) return "mirror";
  return m.ks != vec3(0) && m.ns > 0 ? "highlight" : "matte";
}

std::vector<uint32_t> largest_components(const Topology& topology, size_t most) {
  std::vector<uint32_t> order(topology.components.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto middle = order.begin() + static_cast<std::ptrdiff_t>(std::min(most, order.size()));
  std::partial_sort(order.begin(), middle, order.end(), [&](uint32_t a, uint32_t b) {
    const uint32_t of_a = topology.components[a].triangles, of_b = topology.components[b].triangles;
    return of_a != of_b ? of_a > of_b : a < b;
  });
  order.erase(middle, order.end());
  return order;
}

std::string_view name_of(Winding winding) {
  switch (winding) {
    case Winding::none: return "none";
    case Winding::outward: return "outward";
    case Winding::inward: return "inward";
  }
  return "?";
}

}  // namespace hybridrt::cli
