#include "core/render/picture_record.h"

#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <optional>
#include <vector>

namespace hybridrt {
namespace {

constexpr std::string_view kBytes = "\nbytes=";

std::optional<std::string> contents(const std::filesystem::path& path) {
  std::error_code unreachable;
  if (!std::filesystem::is_regular_file(path, unreachable)) return std::nullopt;
  std::ifstream file(path, std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  return file.bad() ? std::nullopt : std::optional(std::move(text));
}

/// FNV-1a, Fowler, Noll and Vo. Against accidents, not against forgers.
uint64_t hash_of(std::span<const std::byte> bytes) {
  uint64_t hash = 0xcbf29ce484222325ull;
  for (const std::byte byte : bytes) hash = (hash ^ std::to_integer<uint64_t>(byte)) * 0x100000001b3ull;
  return hash;
}

}  // namespace

std::filesystem::path record_path(const std::filesystem::path& picture) { return picture.string() + ".meta"; }

std::string record_text(const std::string& description, std::span<const std::byte> picture) {
  return fmt::format("{}{}{} {:016x}\n", description, kBytes, picture.size(), hash_of(picture));
}

std::string read_record(const std::filesystem::path& picture) {
  const std::optional<std::string> record = contents(record_path(picture)), bytes = contents(picture);
  if (!record || !bytes) return "";
  const std::string description = record->substr(0, record->rfind(kBytes));
  return *record == record_text(description, std::as_bytes(std::span(*bytes))) ? description : "";
}

}  // namespace hybridrt
