#include "core/image_io/deflate.h"

#include <algorithm>
#include <isa-l/igzip_lib.h>
#include <libdeflate.h>
#include <new>

#include "core/base/check.h"
#include "core/base/uninitialized.h"

namespace hybridrt {

struct FastDeflate::Stream {
  isal_zstream state;
  UninitializedVector<uint8_t> level_buffer = UninitializedVector<uint8_t>(ISAL_DEF_LVL2_DEFAULT);
};

FastDeflate::FastDeflate() : stream_(std::make_unique<Stream>()) {
  isal_zstream& state = stream_->state;
  isal_deflate_init(&state);
  state.level = 2;
  state.level_buf = stream_->level_buffer.data();
  state.level_buf_size = ISAL_DEF_LVL2_DEFAULT;
  state.gzip_flag = IGZIP_ZLIB;
}

FastDeflate::~FastDeflate() = default;

void FastDeflate::restart() {
  packed_.clear();
  isal_deflate_reset(&stream_->state);
  stream_->state.gzip_flag = IGZIP_ZLIB;
}

void FastDeflate::add(std::span<const uint8_t> bytes, bool last) {
  constexpr size_t kRoom = size_t{1} << 17;
  isal_zstream& state = stream_->state;
  HRT_CHECK(bytes.size() < (size_t{1} << 32));
  state.next_in = const_cast<uint8_t*>(bytes.data());  // it only reads
  state.avail_in = static_cast<uint32_t>(bytes.size());
  state.end_of_stream = last;
  do {
    const size_t have = packed_.size();
    packed_.resize(have + kRoom);
    state.next_out = packed_.data() + have;
    state.avail_out = kRoom;
    HRT_CHECK_EQ(isal_deflate(&state), COMP_OK);
    packed_.resize(have + kRoom - state.avail_out);
  } while (state.avail_in > 0 || state.avail_out == 0 || (last && state.internal_state.state != ZSTATE_END));
}

PackedBytes deflate_small(std::span<const uint8_t> bytes) {
  const std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> compressor(
      libdeflate_alloc_compressor(9), libdeflate_free_compressor);
  if (!compressor) throw std::bad_alloc();
  PackedBytes packed(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()));
  packed.resize(libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(), packed.data(), packed.size()));
  HRT_CHECK(!packed.empty());
  return packed;
}

}  // namespace hybridrt
