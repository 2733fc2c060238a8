#include "core/render/tile_frame.h"

#include <algorithm>
#include <utility>

#include "core/base/check.h"
#include "core/passes_cpu/mark_boundary.h"
#include "core/trace/prefetch.h"
#include "shaders/shared.h"

namespace hybridrt {
TileWorker::TileWorker(const TileJob& job, TileRaster* raster)
    : job_(job), scene_(job.trace.scene), raster_(raster), generations_(job.trace, job.caster) {}

void TileWorker::render(int tile) {
  PassClock clock(times_ms_);
  raster_->draw(scene_, job_.clusters, job_.bins, tile);
  clock.charge(PassId::id);
  const DepthTile& seen = raster_->depth();
  seen_ = {seen.triangle, seen.x_px, seen.y_px, kTileStride};
  const int x_end = seen.x_px + seen.width_px, y_end = seen.y_px + seen.height_px;
  for (int y = seen.y_px; y < y_end; y += kPart_px)
    for (int x = seen.x_px; x < x_end; x += kPart_px)
      render_part(x, y, std::min(x + kPart_px, x_end), std::min(y + kPart_px, y_end));
}

void TileWorker::render_by_rays(const Tile& part) {
  PassClock clock(times_ms_);
  const View& view = job_.plan.view;
  primary_.clear(), primary_places_.clear();
  part.for_each_pixel_in_blocks([&](int x, int y, uint32_t in_part) { add_primary(view, x, y, in_part); });
  find_triangles();
  clock.charge(PassId::id);
  seen_ = {primary_triangles_.data(), part.x0, part.y0, static_cast<int>(part.width())};
  render_part(part.x0, part.y0, part.x1, part.y1);
}

void TileWorker::add_primary(const View& view, int x, int y, uint32_t place) {
  primary_.push_back({vec3(view.eye), vec3(glm::normalize(view.pixel_dir(x, y)))});
  primary_places_.push_back(place);
}

/// Fills primary_triangles_.
void TileWorker::find_triangles() {
  hits_.resize(primary_.size());
  job_.caster->closest_hits(primary_, hits_);
  primary_triangles_.resize(primary_.size());
  for (size_t i = 0; i < hits_.size(); ++i)
    primary_triangles_[primary_places_[i]] = hits_[i].found() ? hits_[i].triangle : kNoTriangle;
}

void TileWorker::find_by_rays(std::span<const View> views, std::span<const PixelAt> pixels,
                              std::span<uint32_t> triangles) {
  PassClock clock(times_ms_);
  primary_.clear(), primary_places_.clear();
  for (size_t s = 0; s < views.size(); ++s)
    for (size_t i = 0; i < pixels.size(); ++i)
      add_primary(views[s], pixels[i].x, pixels[i].y, static_cast<uint32_t>(i * views.size() + s));
  find_triangles();
  std::ranges::copy(primary_triangles_, triangles.begin());
  clock.charge(PassId::id);
}

void TileWorker::find_in_tile(std::span<const View> views, int tile, std::span<const PixelAt> pixels,
                              std::span<uint32_t> triangles) {
  PassClock clock(times_ms_);
  raster_->find_samples(scene_, job_.clusters, job_.bins, tile, views, pixels, triangles);
  clock.charge(PassId::id);
}

void TileWorker::render_pixels(const View& view, std::span<const PixelAt> pixels, std::span<const uint32_t> triangles,
                               std::span<vec4> colors) {
  PassClock clock(times_ms_);
  HRT_CHECK(pixels.size() <= kMostPixels);
  points_.count = 0;
  for (size_t i = 0; i < pixels.size(); ++i) {
    colors[i] = background();
    if (triangles[i] != kNoTriangle) add_point(pixels[i].x, pixels[i].y, triangles[i], static_cast<uint32_t>(i));
  }
  scattered_ = false;
  render_points(view, clock);
  for (int i = 0; i < points_.count; ++i) colors[places_[i]] = vec4(colors_[0][i], colors_[1][i], colors_[2][i], 1);
  if (!scattered_) return;
  generations_.run(traced_, {}, stats_);
  for (size_t i = 0; i < pixels.size(); ++i) colors[i] += vec4(traced_[i], 0);
  clock.charge(PassId::trace);
}

void TileWorker::render_part(int x0, int y0, int x1, int y1) {
  PassClock clock(times_ms_);
  scattered_ = false;
  for (int y = y0; y < y1; y += kBatchRows) {
    take_points(x0, y, x1, std::min(y + kBatchRows, y1), y0);
    render_points(job_.plan.view, clock);
    keep_colors();
    clock.charge(PassId::shade);
  }
  if (!scattered_) return;
  generations_.run(traced_, {}, stats_);
  add_traced(x0, y0, x1, y1);
  clock.charge(PassId::trace);
}

/// Passes 3 to 5 of the points, but for the rays that they send, which wait. Fills colors_.
void TileWorker::render_points(const View& view, PassClock& clock) {
  if (points_.count == 0) return;
  prefetch_all_corners();
  find_points(scene_, view, job_.trace.lights, points_);
  clock.charge(PassId::mark);
  light_points();
  const double lighting_ms = clock.charge(job_.plan.trace_shadows ? PassId::trace : PassId::mark);
  if (job_.plan.trace_shadows) stats_.shadow_cpu_ms += lighting_ms;
  shade(job_.trace, points_, lit_, colors_);
  stats_.pixels_hit += points_.count;
  for (int i = 0; i < points_.count; ++i) stats_.pixels_lit += lit_[i] != 0;
  clock.charge(PassId::shade);
  if (!job_.plan.trace_scattered) return;
  scatter_points();
  clock.charge(PassId::trace);
}

vec4 TileWorker::background() const {
  return job_.pixels.picture.channels == 4 ? vec4(0) : vec4(job_.trace.background, 0);
}

/// Takes the pixels that see a triangle; the others show the background.
void TileWorker::take_points(int x0, int y0, int x1, int y1, int part_y0) {
  const vec4 unseen = background();
  points_.count = 0;
  for (int y = y0; y < y1; ++y) {
    const uint32_t* const row = seen_.triangles + (y - seen_.y_px) * seen_.stride - seen_.x_px;
    const int row_place = (y - part_y0) * kPart_px - x0;
    for (int x = x0; x < x1; ++x) {
      if (!job_.pixels.ids.empty()) job_.pixels.ids[index_of(x, y)] = row[x];
      if (row[x] != kNoTriangle)
        add_point(x, y, row[x], row_place + x);
      else
        set_pixel(x, y, unseen);
    }
  }
}

void TileWorker::add_point(int x, int y, uint32_t triangle, uint32_t place) {
  const int i = points_.count++;
  if (i == 0 || points_.triangle[i - 1] != triangle) prefetch_numbers(scene_, triangle);
  points_.x[i] = x, points_.y[i] = y;
  points_.triangle[i] = triangle;
  places_[i] = place;
}

void TileWorker::prefetch_all_corners() const {
  for (int i = 0; i < points_.count; ++i)
    if (i == 0 || points_.triangle[i - 1] != points_.triangle[i]) prefetch_corners(scene_, points_.triangle[i]);
}

void TileWorker::keep_colors() {
  for (int i = 0; i < points_.count; ++i)
    set_pixel(points_.x[i], points_.y[i], vec4(colors_[0][i], colors_[1][i], colors_[2][i], 1));
}

void TileWorker::set_pixel(int x, int y, const vec4& color) const {
  float* const to = pixel(x, y);
  to[0] = color.x, to[1] = color.y, to[2] = color.z;
  if (job_.pixels.picture.channels == 4) to[3] = color.w;
}

/// Fills lit_.
void TileWorker::light_points() {
  const TraceJob& trace = job_.trace;
  lit_.assign(points_.facing, points_.facing + points_.count);
  if (!job_.plan.trace_shadows) return;
  for (size_t l = 0; l < trace.lights.size(); ++l)
    if (trace.casts_shadow(l)) ask_light(l);
  if (job_.pixels.lit.empty()) return;
  const size_t pixel_count = job_.pixels.lit.size() / trace.lights.size();
  for (size_t l = 0; l < trace.lights.size(); ++l)
    for (int i = 0; i < points_.count; ++i)
      job_.pixels.lit[l * pixel_count + index_of(points_.x[i], points_.y[i])] = lit_[i] >> l & 1 ? HRT_MASK_LIT : 0;
}

/// Pass 3 and the shadow rays of pass 4: which points the light reaches.
void TileWorker::ask_light(size_t light) {
  const LightBuffer& buffer = *job_.trace.lights[light].buffer;
  queries_.clear(), asking_.clear();
  for (int i = 0; i < points_.count; ++i) {
    if (!(points_.facing[i] >> light & 1)) continue;
    queries_.push_back({dvec3(points_.origin[0][i], points_.origin[1][i], points_.origin[2][i]), points_.triangle[i],
                        points_.from_front[i] != 0, job_.trace.eye_enclosed, /*is_precise=*/true});
    asking_.push_back(i);
  }
  marked_queries_.clear(), marked_.clear();
  if (job_.plan.mark_exact) {
    answers_.resize(queries_.size());
    answers_of_cells(buffer, queries_, answers_);
    for (size_t k = 0; k < queries_.size(); ++k) {
      if (answers_[k] == CellAnswer::lit) continue;
      if (answers_[k] == CellAnswer::shadow) {
        lit_[asking_[k]] &= static_cast<uint8_t>(~(1u << light));
        continue;
      }
      marked_queries_.push_back(queries_[k]);
      marked_.push_back(asking_[k]);
    }
    if (!job_.pixels.mask.empty()) keep_masks(light);
  } else {
    marked_queries_.swap(queries_), marked_.swap(asking_);
  }
  occluded_.resize(marked_.size());
  shadow_answers(buffer, marked_queries_, occluded_);
  for (size_t k = 0; k < marked_.size(); ++k)
    if (occluded_[k]) lit_[marked_[k]] &= static_cast<uint8_t>(~(1u << light));
  const auto asked = static_cast<int64_t>(marked_.size());
  stats_.pixels_marked += asked, stats_.shadow_rays += asked, stats_.primary_shadow_rays += asked;
}

void TileWorker::keep_masks(size_t light) {
  const size_t first = light * (job_.pixels.mask.size() / job_.trace.lights.size());
  for (size_t k = 0; k < answers_.size(); ++k)
    job_.pixels.mask[first + index_of(points_.x[asking_[k]], points_.y[asking_[k]])] = mask_of(answers_[k]);
}

/// Queues the rays that the points reflect and refract.
void TileWorker::scatter_points() {
  for (int i = 0; i < points_.count; ++i) {
    const uint32_t triangle = points_.triangle[i];
    const Material& material = scene_.material_of(triangle);
    if (!material.reflective() && !material.transmissive()) continue;
    if (!scattered_) traced_.assign(kPart_px * kPart_px, vec3(0));
    scattered_ = true;
    const vec3 dir(points_.dir[0][i], points_.dir[1][i], points_.dir[2][i]);
    generations_.add_seen(places_[i], triangle, points_.u[i], points_.v[i], dir,
                          scene_.textures ? points_.distance[i] : 0, scene_.textures ? points_.solid_angle[i] : 0,
                          stats_);
  }
}

void TileWorker::add_traced(int x0, int y0, int x1, int y1) {
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) {
      const vec4 light(traced_[(y - y0) * kPart_px + x - x0], 0);
      for (int c = 0; c < 3; ++c) pixel(x, y)[c] += light[c];
      if (!job_.pixels.traced.empty()) job_.pixels.traced[index_of(x, y)] = light;
    }
}

}  // namespace hybridrt
