#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace hybridrt {

// What a picture is of, beside a picture whose format has no place for it. The record vouches for the picture's very
// bytes: one that was replaced since by another program, or by a run that was killed before it could write the record,
// is not taken for it.

/// `a.0001.bmp.meta` for `a.0001.bmp`.
std::filesystem::path record_path(const std::filesystem::path& picture);

/// The record's text. `description`: description_of(ImageMetadata).
std::string record_text(const std::string& description, std::span<const std::byte> picture);

/// The description in the picture's record; empty if there is none, or it is not of the picture as it is now.
std::string read_record(const std::filesystem::path& picture);

}  // namespace hybridrt
