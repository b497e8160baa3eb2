#include "verify/packed.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace maxwrench {
namespace {

constexpr int kUsualMemory = 8;  // the usual memory level of deflate

/// Gives the stream its next input when it has read all of the last. The input is split because
/// zlib counts in 32 bits.
void feed(std::string_view& rest, z_stream& stream) {
  if (stream.avail_in != 0) return;
  const std::size_t size = std::min<std::size_t>(rest.size(), 1U << 30);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(rest.data()));
  stream.avail_in = static_cast<uInt>(size);
  rest.remove_prefix(size);
}

/// Appends the output of `step` on the stream's input to `text`, and returns the result of `step`.
template <class Step>
int append(std::string& text, z_stream& stream, const Step& step) {
  std::array<char, 1U << 16> chunk;
  stream.next_out = reinterpret_cast<Bytef*>(chunk.data());
  stream.avail_out = chunk.size();
  const int how = step();
  text.append(chunk.data(), chunk.size() - stream.avail_out);
  return how;
}

std::string deflated(std::string_view text, Wrapping wrapping, int level) {
  z_stream stream{};
  if (deflateInit2(&stream, level, Z_DEFLATED, static_cast<int>(wrapping), kUsualMemory,
                   Z_DEFAULT_STRATEGY) != Z_OK) {
    throw std::runtime_error("zlib: got no memory");
  }
  std::string packed;
  int how = Z_OK;
  while (how == Z_OK) {
    feed(text, stream);
    how = append(packed, stream,
                 [&] { return deflate(&stream, text.empty() ? Z_FINISH : Z_NO_FLUSH); });
  }
  deflateEnd(&stream);
  return packed;
}

}  // namespace

bool is_gzip(std::string_view text) { return text.starts_with("\x1f\x8b"); }

std::string pack(std::string_view text, Wrapping wrapping, int level, std::uint64_t most) {
  const std::string packed = deflated(text, wrapping, level);
  return text.size() / most > packed.size() ? deflated(text, wrapping, Z_NO_COMPRESSION) : packed;
}

std::optional<std::string> unpack(std::string_view packed, Wrapping wrapping, std::uint64_t most) {
  z_stream stream{};
  if (inflateInit2(&stream, static_cast<int>(wrapping)) != Z_OK) {
    throw std::runtime_error("zlib: got no memory");
  }
  std::string text;
  std::string_view rest = packed;
  int how = Z_OK;
  while (how == Z_OK && text.size() / most <= packed.size()) {
    feed(rest, stream);
    how = append(text, stream, [&] { return inflate(&stream, Z_NO_FLUSH); });
  }
  const bool whole = how == Z_STREAM_END && stream.avail_in == 0 && rest.empty();
  inflateEnd(&stream);
  if (!whole || text.size() / most > packed.size()) return std::nullopt;
  return text;
}

}  // namespace maxwrench
