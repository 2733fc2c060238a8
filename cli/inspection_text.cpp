#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>

#include "cli/inspection.h"
#include "cli/warning_output.h"
#include "core/base/error.h"
#include "core/base/memory.h"

namespace hybridrt::cli {
namespace {

constexpr uint64_t kNoLimit = std::numeric_limits<uint64_t>::max();
constexpr size_t kMostComponents = 5, kMostMaterials = 60, kMostNameBytes = 60;

/// 1234567 as 1,234,567.
std::string grouped(size_t number) {
  std::string digits = fmt::format("{}", number);
  for (size_t i = digits.size(); i > 3; i -= 3) digits.insert(i - 3, 1, ',');
  return digits;
}

template <typename Vector>
std::string point(const Vector& v) {
  return fmt::format("{:.9g} {:.9g} {:.9g}", v.x, v.y, v.z);
}

/// One number when all three are equal.
std::string color(const vec3& c) {
  return c.x == c.y && c.y == c.z ? fmt::format("{:.3g}", c.x) : fmt::format("{:.3g} {:.3g} {:.3g}", c.x, c.y, c.z);
}

/// A name from a file, made safe for a terminal: printable, and cut between characters if it is long.
std::string shown(std::string_view name) {
  std::string text;
  for (char c : name.substr(0, kMostNameBytes)) text += static_cast<unsigned char>(c) < 32 || c == 127 ? '?' : c;
  if (name.size() > kMostNameBytes) {
    while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xC0) == 0x80) text.pop_back();
    if (!text.empty() && static_cast<unsigned char>(text.back()) >= 0xC0) text.pop_back();
    text += "…";
  }
  return text;
}

std::string loaded_text(const Inspection& in) {
  const Scene& scene = in.job.scene;
  const dvec3 lo(scene.bounds.lo), hi(scene.bounds.hi);
  const size_t corners = 3 * scene.triangle_count(), built = scene.built_normal_corners;
  std::string out = in.scene + "\n";
  for (const std::string& file : scene.files)
    if (file != in.scene) out += fmt::format("  {:<12}{}\n", "with", in_one_line(file));
  out += fmt::format("  {:<12}{}\n", "triangles", grouped(scene.triangle_count()));
  out += fmt::format("  {:<12}{}\n", "vertices", grouped(scene.positions.size()));
  out += fmt::format("  {:<12}{}\n", "normals",
                     built == 0 ? "given"
                     : built == corners
                         ? "built from the faces; none given"
                         : fmt::format("given at {} corners, built at {}", grouped(corners - built), grouped(built)));
  out += fmt::format("  {:<12}{}  to  {}\n", "bounds", point(scene.origin_world + lo), point(scene.origin_world + hi));
  out += fmt::format("  {:<12}{}\n", "extent", point(hi - lo));
  if (scene.textures)
    out += fmt::format("  {:<12}{}{}\n", "textures", size_text(4 * scene.textures->words.size()),
                       scene.has_holes() ? ", some with holes" : "");
  for (const std::string& note : scene.notes) out += fmt::format("  {:<12}{}\n", "note", in_one_line(note));
  if (scene.origin_world != dvec3(0))
    out += fmt::format("  {:<12}moved to {} to keep precision\n", "origin", point(scene.origin_world));
  return out;
}

std::string warnings_text(const Warnings& warnings) {
  std::string out = "\nrepaired or left out\n";
  for (const Warning& warning : warnings) out += fmt::format("  - {}\n", text_of(warning));
  return warnings.empty() ? out + "  nothing\n" : out;
}

/// "closed, wound outward", or why it is not closed.
std::string state_of(const Component& c) {
  if (c.degenerate) return "without area";
  if (c.closed())
    return c.winding == Winding::none ? "closed, without volume" : fmt::format("closed, wound {}", name_of(c.winding));
  std::vector<std::string> why;
  if (c.boundary_edges > 0) why.push_back(grouped(c.boundary_edges) + " boundary");
  if (c.inconsistent_edges > 0) why.push_back(grouped(c.inconsistent_edges) + " inconsistent");
  if (c.non_manifold_edges > 0) why.push_back(grouped(c.non_manifold_edges) + " non-manifold");
  return fmt::format("open: {} edges", fmt::join(why, ", "));
}

std::string topology_text(const Topology& t) {
  size_t closed = 0;
  for (const Component& component : t.components) closed += component.closed();
  std::string out = fmt::format("\ncomponents    {}: {} closed, {} open\n", grouped(t.components.size()),
                                grouped(closed), grouped(t.components.size() - closed));
  for (uint32_t i : largest_components(t, kMostComponents))
    out += fmt::format("  {:>12} triangles  {}\n", grouped(t.components[i].triangles), state_of(t.components[i]));
  if (t.components.size() > kMostComponents)
    out += fmt::format("  {:>12} more, smaller or equal\n", grouped(t.components.size() - kMostComponents));
  out += fmt::format("edges         {}: {} boundary, {} inconsistently wound, {} non-manifold\n", grouped(t.edge_count),
                     grouped(t.boundary_edges), grouped(t.inconsistent_edges), grouped(t.non_manifold_edges));
  return out;
}

std::string materials_text(const Inspection& in) {
  const std::vector<Material>& materials = in.job.scene.materials;
  const size_t rows = std::min(materials.size(), kMostMaterials);
  size_t width = 4;
  for (size_t i = 0; i < rows; ++i) width = std::max(width, fmt::formatted_size("{:}", shown(materials[i].name)));
  width = std::min<size_t>(width, 32);
  std::string out = fmt::format("\nmaterials     {}\n", materials.size());
  out += fmt::format("  {:<{}} {:>11}  {:<12}{:>5}  {:<18}{:<18}{:>6} {:>6} {:>6}\n", "name", width, "triangles",
                     "kind", "illum", "Kd", "Ks", "Ns", "d", "Ni");
  for (size_t i = 0; i < rows; ++i) {
    const Material& m = materials[i];
    out += fmt::format("  {:<{}} {:>11}  {:<12}{:>5}  {:<18}{:<18}{:>6.4g} {:>6.3g} {:>6.4g}", shown(m.name), width,
                       grouped(in.material_triangles[i]), kind_of(m), m.illum, color(m.kd), color(m.ks), m.ns,
                       m.opacity, m.ni);
    if (m.ke != vec3(0)) out += "  Ke " + color(m.ke);
    if (m.transmissive() && m.tf != vec3(1)) out += "  Tf " + color(m.tf);
    out += "\n";
  }
  if (rows < materials.size()) out += fmt::format("  … {} more\n", materials.size() - rows);
  return out;
}

std::string memory_text(const Inspection& in) {
  const MemoryEstimate& m = in.memory;
  std::string out = "\nmemory, about\n";
  const auto line = [&](const char* what, size_t bytes) {
    if (bytes > 0) out += fmt::format("  {:<22}{:>12}\n", what, size_text(bytes));
  };
  line("scene", m.scene);
  line("topology", m.topology);
  line("scene on the GPU", m.gpu_scene);
  line("frames on the GPU", m.gpu_frames);
  line("frames", m.frames);
  line("pictures to be written", m.pictures);
  line("ray accelerator", m.accelerator);
  line("in all", m.total());
  if (in.job.most_bytes < kNoLimit) line("allowed", in.job.most_bytes);
  return out;
}

std::string frame_text(const Inspection& in) {
  const RenderSettings& s = in.job.settings;
  const Camera camera = camera_at(in.job.motion, in.plan.number);
  const int64_t frames = in.job.frames.count();
  std::string out = fmt::format("\nframe {}{}: {} x {}, method {}, shadows {}\n", in.plan.number,
                                frames > 1 ? fmt::format(", the first of {}", grouped(frames)) : "", s.width_px,
                                s.height_px, name_of(s.method), name_of(s.shadows));
  out += fmt::format("  {:<22}{}{}\n", "eye", point(camera.eye_world),
                     std::holds_alternative<Orbit>(in.job.motion.course) ? ", on an orbit" : "");
  out += fmt::format("  {:<22}{}\n", "target", point(camera.target_world));
  for (const DirectionalLight& light : in.plan.lights)
    out += fmt::format("  {:<22}{}, colour {}{}\n", "toward the light", point(light.toward), color(light.color),
                       light.casts_shadow ? "" : ", casts no shadow");
  if (in.plan.lights.empty()) out += fmt::format("  {:<22}none: ambient light and Ke only\n", "lights");
  if (!uses_gl(s))
    out += fmt::format("  {:<22}on the CPU{}\n", "all passes",
                       in.job.forms_reason.empty() ? "" : fmt::format(" ({})", in.job.forms_reason));
  for (const StepNote& note : in.steps)
    out += fmt::format("  {:<22}{:<12}{}\n", note.step, name_of(note.runs), note.why);
  return out;
}

}  // namespace

std::string inspection_text(const Inspection& in) {
  return loaded_text(in) + warnings_text(in.warnings) + topology_text(in.job.topology) + materials_text(in) +
         memory_text(in) + frame_text(in);
}

}  // namespace hybridrt::cli
