#include "cli/frame_writer.h"

#include <algorithm>
#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "core/base/timing.h"
#include "core/image_io/encode_image.h"
#include "core/image_io/read_image.h"
#include "core/render/aov.h"
#include "core/render/memory_estimate.h"
#include "core/render/picture_files.h"
#include "core/render/picture_record.h"
#include "core/scene/view.h"

namespace hybridrt::cli {
namespace {

constexpr int kSheetColumns = 4, kSheetCell_px = 320, kTallestSheetCell_px = 4 * kSheetCell_px, kMostSheetCells = 20;
constexpr int kNoFrame = std::numeric_limits<int>::min();

/// For the headers of pictures that keep it.
ImageCamera image_camera(const Camera& camera, const RenderSettings& s) {
  const View view = make_view(camera, dvec3(0), s.width_px, s.height_px);
  const dmat4 camera_from_world = glm::lookAt(camera.eye_world, camera.eye_world + view.forward, view.up);
  const double nearest = 1e-3 * glm::distance(camera.eye_world, camera.target_world);
  const dmat4 ndc_from_camera =
      glm::infinitePerspective(camera.fov_y_rad, static_cast<double>(s.width_px) / s.height_px, nearest);
  // Columns one after the other are the rows of a matrix for row vectors.
  const mat4 to_camera(camera_from_world), to_ndc(ndc_from_camera * camera_from_world);
  ImageCamera result;
  std::copy_n(glm::value_ptr(to_camera), 16, result.camera_from_world.begin());
  std::copy_n(glm::value_ptr(to_ndc), 16, result.ndc_from_world.begin());
  return result;
}

struct CellSize {
  int width_px, height_px;
};

CellSize cell_size(int picture_width_px, int picture_height_px) {
  // A picture of one column would fill gigabytes at the usual width.
  const int64_t usual_height = int64_t{picture_height_px} * kSheetCell_px / picture_width_px;
  const bool is_tall = usual_height > kTallestSheetCell_px;
  const int width = is_tall ? std::max(1, kTallestSheetCell_px * picture_width_px / picture_height_px) : kSheetCell_px;
  return {width, std::max(1, static_cast<int>(int64_t{picture_height_px} * width / picture_width_px))};
}

}  // namespace

SheetCollector::SheetCollector(const FrameSpec& frames) {
  const int64_t step = std::max<int64_t>(1, (frames.count() + kMostSheetCells - 1) / kMostSheetCells);
  FrameCursor cursor(frames);
  int64_t place = 0;
  while (const std::optional<int> frame = cursor.next())
    if (place++ % step == 0) shown_.insert(*frame);
}

void SheetCollector::add(const Frame& frame) {
  if (!shows(frame.number)) return;
  const CellSize cell = cell_size(frame.picture.width_px, frame.picture.height_px);
  cells_.push_back(box_filtered(frame.picture, cell.width_px, cell.height_px));
}

uint64_t SheetCollector::most_bytes(const RenderSettings& settings, int64_t frame_count) {
  constexpr uint64_t kCopies = 4;  // cells, thumbnails made of them, the sheet with its empty places, and it encoded
  const PixelRect picture = picture_rect(settings);
  const CellSize cell = cell_size(picture.width_px, picture.height_px);
  const auto cells = static_cast<uint64_t>(std::min<int64_t>(frame_count, kMostSheetCells));
  return kCopies * std::max<uint64_t>(cells, kSheetColumns) * static_cast<uint64_t>(cell.width_px) *
         static_cast<uint64_t>(cell.height_px) * sizeof(float) * (settings.alpha ? 4 : 3);
}

Image SheetCollector::sheet() const {
  return contact_sheet(cells_, kSheetColumns, cells_.empty() ? kSheetCell_px : cells_.front().width_px);
}

FrameWriter::FrameWriter(const OutputOptions& options, const OutputPaths& paths, const RenderJob& job, int threads)
    : options_(options),
      paths_(paths),
      job_(job),
      layered_(paths.stream.name.empty() && keeps_layers(output_path(paths.pattern, job.frames.lowest()).string())),
      with_record_(paths.stream.name.empty() &&
                   !keeps_metadata(output_path(paths.pattern, job.frames.lowest()).string())),
      sheet_(options.contact_sheet.empty() ? FrameSpec{{}} : job.frames),
      sink_([encode = encode_options(options)](
                const Image& picture, const std::filesystem::path& path,
                const ImageMetadata& metadata) { return encode_image(picture, path.string(), metadata, encode); },
            threads, most_written_bytes(job.settings, threads)) {
  if (!paths.stream.name.empty())
    stream_.emplace(paths.stream, encode_options(options), most_written_bytes(job.settings, threads));
  if (paths.timings.empty()) return;
  std::optional<TimingsRows> rows;
  if (options.existing == Existing::resume) rows = read_timings_rows(paths.timings);
  goes_on_with_rows_ = rows.has_value();
  timings_.emplace(paths.timings, std::move(rows).value_or(TimingsRows()));
}

bool FrameWriter::is_kept(int frame) {
  if (options_.existing != Existing::resume || sheet_.shows(frame)) return false;
  if (goes_on_with_rows_ && !timings_->has_earlier(frame)) return false;
  const std::string expected = description_of(frame_metadata(metadata_, job_, frame));
  const auto is_as_expected = [&](const std::filesystem::path& file) {
    return (with_record_ ? read_record(file) : read_description(file)) == expected;
  };
  if (!is_as_expected(output_path(paths_.pattern, frame))) return false;
  const std::vector<std::string_view> aovs = layered_ ? std::vector<std::string_view>() : aov_names(job_.settings.aovs);
  return std::all_of(aovs.begin(), aovs.end(),
                     [&](std::string_view aov) { return is_as_expected(output_path(paths_.pattern, frame, aov)); });
}

bool FrameWriter::keeps(int frame) {
  const bool kept = is_kept(frame);
  asked_.emplace_back(frame, kept);
  return kept;
}

void FrameWriter::add_kept_rows_before(int frame) {
  for (; !asked_.empty() && asked_.front().first != frame; asked_.pop_front())
    if (timings_ && asked_.front().second) timings_->add_earlier(asked_.front().first);
  if (!asked_.empty()) asked_.pop_front();
}

void FrameWriter::write(Frame&& frame) {
  const int number = frame.number;
  const ImageMetadata metadata = frame_metadata(metadata_, job_, number);
  const auto written = [this, number](double ms) {
    if (timings_) timings_->file_written(number, ms);
  };
  add_kept_rows_before(number);
  if (timings_) timings_->add(frame, static_cast<int>(layered_ ? 1 : 1 + frame.aovs.size()));
  sheet_.add(frame);
  if (stream_) return stream_->submit(std::move(frame.picture), metadata, written);
  if (layered_) {
    frame.picture.camera = image_camera(frame_request(job_, number).camera, job_.settings);
    frame.picture.layers = std::move(frame.aovs);
  } else {
    for (const ImageLayer& aov : frame.aovs)
      sink_.submit(output_path(paths_.pattern, number, aov.name),
                   display_image(aov, frame.picture.width_px, frame.picture.height_px), written, metadata,
                   with_record_);
  }
  sink_.submit(output_path(paths_.pattern, number), std::move(frame.picture), written, metadata, with_record_);
}

void FrameWriter::finish(RunTotals& totals) {
  const Stopwatch draining;
  sink_.drain();
  if (stream_) stream_->finish();
  totals.drain_ms = draining.elapsed_ms();
  add_kept_rows_before(kNoFrame);
  if (timings_) {
    timings_->finish();
    totals.write_ms = timings_->written_ms();
  }
  if (!options_.contact_sheet.empty() && totals.frames > 0) sink_.submit(options_.contact_sheet, sheet_.sheet());
  sink_.drain();
}

}  // namespace hybridrt::cli
