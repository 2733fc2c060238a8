#include "core/render/file_sink.h"

#include <memory>
#include <span>
#include <utility>

#include "core/base/check.h"
#include "core/base/output_file.h"
#include "core/base/timing.h"
#include "core/render/picture_record.h"

namespace hybridrt {
namespace fs = std::filesystem;

FileSink::FileSink(EncodeFunction encode, int workers, size_t most_bytes)
    : encode_(std::move(encode)), queue_(workers, most_bytes) {
  HRT_CHECK(encode_);
}

void FileSink::submit(fs::path path, Image image, Done done, ImageMetadata metadata, bool with_record) {
  const size_t bytes = memory_bytes(image);
  const auto job =
      std::make_shared<const Job>(std::move(path), std::move(image), std::move(metadata), std::move(done), with_record);
  queue_.submit(bytes, [this, job] { write(*job); });
}

void FileSink::write(const Job& job) {
  const Stopwatch stopwatch;
  const std::vector<unsigned char> bytes = encode_(job.image, job.path, job.metadata);
  std::error_code missing;
  if (job.with_record) fs::remove(record_path(job.path), missing);
  write_file_atomically(job.path, std::as_bytes(std::span(bytes)));
  if (job.with_record)
    write_file_atomically(record_path(job.path),
                          record_text(description_of(job.metadata), std::as_bytes(std::span(bytes))));
  if (!job.done) return;
  const double write_ms = stopwatch.elapsed_ms();
  std::lock_guard lock(one_done_at_a_time_);
  job.done(write_ms);
}

}  // namespace hybridrt
