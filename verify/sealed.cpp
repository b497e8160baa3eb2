#include "verify/sealed.h"

#include <zlib.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "verify/bytes.h"
#include "verify/packed.h"

namespace maxwrench {
namespace {

/// A file has at least one byte for this many bytes of its contents. A small file therefore cannot
/// fill the memory. Contents that would pack better, such as boxes without a multiplier, are stored
/// without compression.
constexpr std::uint64_t kMostPacked = 16;

std::uint64_t checksum(std::string_view text) {
  return crc32_z(0, reinterpret_cast<const Bytef*>(text.data()), text.size());
}

/// The unpacked contents; empty if they are damaged.
std::string unpacked(std::string_view text) {
  ByteReader sum(text);
  const std::uint64_t claimed = sum.whole(4);
  if (!sum.good() || claimed != checksum(text.substr(4))) return "";
  ByteReader head(text.substr(4));
  const std::uint64_t length = head.whole(8);
  if (!head.good()) return "";
  const auto raw = unpack(text.substr(12), Wrapping::kZlib, kMostPacked);
  return raw && raw->size() == length ? *raw : "";
}

}  // namespace

std::string seal(std::string_view first_line, const std::string& raw) {
  ByteWriter head;
  head.whole(raw.size(), 8);
  const std::string all = head.text() + pack(raw, Wrapping::kZlib, Z_BEST_SPEED, kMostPacked);
  ByteWriter sum;
  sum.whole(checksum(all), 4);
  return std::string(first_line) + sum.text() + all;
}

bool begins_with(const std::string& file, std::string_view first_line) {
  std::ifstream stream(file, std::ios::binary);
  std::string start(first_line.size(), '\0');
  stream.read(start.data(), static_cast<std::streamsize>(start.size()));
  return stream && start == first_line;
}

std::string unseal(const std::string& file, std::string_view first_line) {
  std::ifstream stream(file, std::ios::binary);
  std::string start(first_line.size(), '\0');
  stream.read(start.data(), static_cast<std::streamsize>(start.size()));
  if (!stream.is_open() || stream.bad()) {
    throw std::invalid_argument(file + ": got no data, expected a readable file");
  }
  if (!stream || start != first_line) {
    throw std::invalid_argument(file + ": got something else, expected a certificate of 'certify'");
  }
  const std::string rest{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  return unpacked(rest);
}

std::uint64_t digest_of(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char byte : bytes) {
    hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3U;
  }
  return hash;
}

bool fits_in_a_line(const std::string& text) {
  return std::none_of(text.begin(), text.end(),
                      [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; });
}

}  // namespace maxwrench
