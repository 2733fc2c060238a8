#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "core/base/math.h"
#include "core/base/named.h"
#include "core/scene/scene.h"

namespace hybridrt {

enum class Method { hybrid, raster, raytrace, reference };
enum class ShadowMode { none, map, blur, exact, rays };
enum class ShadowWarp { uniform, lispsm };  ///< how `map` and `blur` fit their shadow map
enum class Accel { kdtree, embree };

inline constexpr Named<Method> kMethods[] = {{"hybrid", Method::hybrid},
                                             {"raster", Method::raster},
                                             {"raytrace", Method::raytrace},
                                             {"reference", Method::reference}};
inline constexpr Named<ShadowMode> kShadowModes[] = {{"none", ShadowMode::none},
                                                     {"map", ShadowMode::map},
                                                     {"blur", ShadowMode::blur},
                                                     {"exact", ShadowMode::exact},
                                                     {"rays", ShadowMode::rays}};
inline constexpr Named<ShadowWarp> kShadowWarps[] = {{"uniform", ShadowWarp::uniform}, {"lispsm", ShadowWarp::lispsm}};
inline constexpr Named<Accel> kAccels[] = {{"kdtree", Accel::kdtree}, {"embree", Accel::embree}};

constexpr std::string_view name_of(Method method) { return name_in(kMethods, method); }
constexpr std::string_view name_of(ShadowMode shadows) { return name_in(kShadowModes, shadows); }
constexpr std::string_view name_of(ShadowWarp warp) { return name_in(kShadowWarps, warp); }
constexpr std::string_view name_of(Accel accel) { return name_in(kAccels, accel); }

/// Pictures of a frame besides the final one (the paper's figure 3); bits.
enum Aov : uint32_t {
  kAovId = 1,       ///< triangle numbers hashed to colours
  kAovShadow = 2,   ///< white where the light arrives
  kAovMarked = 4,   ///< where pass 3 marked, and why: MarkReason
  kAovTraced = 8,   ///< light of reflected and refracted rays
  kAovDepth = 16,   ///< distance along the view
  kAovNormal = 32,  ///< shading normal
};

inline constexpr Named<uint32_t> kAovs[] = {{"id", kAovId},         {"shadow", kAovShadow}, {"marked", kAovMarked},
                                            {"traced", kAovTraced}, {"depth", kAovDepth},   {"normal", kAovNormal}};

/// Values of the AOV `marked`.
enum MarkReason {
  kNotMarked = 0,
  kMarkedBoundary = 1,  ///< near a shadow's edge, or unanswered by the light buffer's cells; white
  kMarkedInside = 2,    ///< its point may lie inside a closed body; red
  kMarkedRepaired = 3,  ///< another triangle than the rasterised one is seen at the pixel's centre; yellow
};

/// A part of a frame; row 0 on top.
struct PixelRect {
  int x_px = 0, y_px = 0, width_px = 0, height_px = 0;
};

/// Where passes 1, 2, 3 and 5 run: drawn by OpenGL, as in the paper, or computed on the CPU without any GL.
enum class PassForms { gl, cpu };

inline constexpr int kLargestBlurKernel_px = 31;

/// How frames are rendered; Scene and Camera say what is in them.
struct RenderSettings {
  int width_px = 1024, height_px = 768;  ///< size of the frame
  std::optional<PixelRect> crop;         ///< the part of it that becomes the picture; inside the frame
  Method method = Method::hybrid;
  PassForms forms = PassForms::gl;  ///< of the methods hybrid and raster
  ShadowMode shadows = ShadowMode::exact;
  int blur_kernel_px = 5;  ///< odd, at most kLargestBlurKernel_px
  int shadow_map_px = 2048;
  ShadowWarp shadow_warp = ShadowWarp::lispsm;
  int reflection_depth = 4;  ///< generations after the primary one
  int samples = 1;           ///< samples per pixel, averaged
  bool adaptive = false;     ///< only the first, where no edges are (edge_samples.h)
  Accel accel = Accel::embree;
  int frames_in_flight = 2;
  uint32_t aovs = 0;                     ///< Aov bits
  AmbientLight ambient;                  ///< times Kd
  vec3 background{0.21f, 0.25f, 0.32f};  ///< linear
  bool alpha = false;                    ///< pictures with a fourth channel, coverage, in place of the background
};

/// The part of the frame that is delivered: the crop, or all of it.
PixelRect picture_rect(const RenderSettings& settings);

/// The part that is rendered for it: pass 3's blur must see half a kernel beyond the crop's edges, or the pixels there
/// would differ from those of the whole frame.
PixelRect rendered_rect(const RenderSettings& settings);

/// Whether that is less than the frame.
bool renders_part(const RenderSettings& settings);

/// Whether frames are drawn by OpenGL.
bool uses_gl(const RenderSettings& settings);

/// Whether pixels near edges have more samples than the others.
bool takes_edge_samples(const RenderSettings& settings);

/// Throws Error(usage) for `adaptive` with a single sample, or with shadow maps: rays take its samples, which see none.
void require_adaptive_fits(const RenderSettings& settings);

/// Whether frames have a shadow map.
bool uses_shadow_map(const RenderSettings& settings);

/// The place of the delivered part in the rendered one.
PixelRect kept_of_rendered(const RenderSettings& settings);

/// Whether the method supports the shadow mode (the table in README.md).
bool method_takes(Method method, ShadowMode shadows);

/// Throws Error(usage) unless the method supports the shadow mode (the table in README.md).
void require_method_takes(Method method, ShadowMode shadows);

/// A method's default shadow mode: exact, map or rays.
ShadowMode default_shadows(Method method);

}  // namespace hybridrt
