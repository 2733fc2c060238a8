#include "cli/frame_writer.h"

#include <algorithm>
#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "cli/version.h"
#include "core/base/output_file.h"
#include "core/base/timing.h"
#include "core/image_io/encode_image.h"
#include "core/render/aov.h"
#include "core/render/fingerprint.h"
#include "core/scene/view.h"

namespace hybridrt::cli {
namespace {

constexpr int kSheetColumns = 4, kSheetCell_px = 320, kMostSheetCells = 20;

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

}  // namespace

SheetCollector::SheetCollector(int64_t frames)
    : step_(std::max<int64_t>(1, (frames + kMostSheetCells - 1) / kMostSheetCells)) {}

void SheetCollector::add(const Image& picture) {
  if (seen_++ % step_ != 0) return;
  const int height = std::max(1, picture.height_px * kSheetCell_px / picture.width_px);
  cells_.push_back(box_filtered(picture, kSheetCell_px, height));
}

Image SheetCollector::sheet() const { return contact_sheet(cells_, kSheetColumns, kSheetCell_px); }

FrameWriter::FrameWriter(const OutputOptions& options, const OutputPaths& paths, const RenderJob& job, int threads)
    : options_(options),
      paths_(paths),
      job_(job),
      scene_fingerprint_(fingerprint(job.scene)),
      layered_(paths.stream.empty() && keeps_layers(output_path(paths.pattern, job.frames.lowest()).string())),
      sheet_(job.frames.count()),
      sink_(encode_image_file, threads, static_cast<size_t>(2 * threads)) {
  if (!paths.timings.empty()) timings_.emplace(paths.timings);
}

void FrameWriter::write_to_stream(const Image& picture, const ImageMetadata& metadata) {
  const std::vector<unsigned char> bytes = encode_image(picture, "png", metadata);
  OutputFile file = paths_.stream == "-" ? OutputFile::standard_output() : OutputFile(paths_.stream);
  file.write(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
  file.commit();
}

void FrameWriter::write(Frame&& frame) {
  const int number = frame.number;
  const FrameRequest request = frame_request(job_, number);
  const ImageMetadata metadata = {
      {"hybridrt", kVersion},
      {"settings", settings_line(job_.settings)},
      {"fingerprint", fmt::format("{:016x}", fingerprint(scene_fingerprint_, request, job_.settings))}};
  const auto written = [this, number](double ms) {
    if (timings_) timings_->file_written(number, ms);
  };
  if (timings_) timings_->add(frame, static_cast<int>(layered_ ? 1 : 1 + frame.aovs.size()));
  if (!options_.contact_sheet.empty()) sheet_.add(frame.picture);
  if (!paths_.stream.empty()) {
    const Stopwatch writing;
    write_to_stream(frame.picture, metadata);
    return written(writing.elapsed_ms());
  }
  if (layered_) {
    frame.picture.camera = image_camera(request.camera, job_.settings);
    frame.picture.layers = std::move(frame.aovs);
  } else {
    for (const ImageLayer& aov : frame.aovs)
      sink_.submit(output_path(paths_.pattern, number, aov.name),
                   display_image(aov, frame.picture.width_px, frame.picture.height_px), written, metadata);
  }
  sink_.submit(output_path(paths_.pattern, number), std::move(frame.picture), written, metadata);
}

void FrameWriter::finish(RunTotals& totals) {
  const Stopwatch draining;
  sink_.drain();
  totals.drain_ms = draining.elapsed_ms();
  if (timings_) {
    timings_->finish();
    totals.write_ms = timings_->written_ms();
  }
  if (!options_.contact_sheet.empty() && totals.frames > 0) sink_.submit(options_.contact_sheet, sheet_.sheet());
  sink_.drain();
}

}  // namespace hybridrt::cli
