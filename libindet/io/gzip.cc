#include "libindet/io/gzip.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>

#include "libindet/base/error.h"

namespace indet {
namespace {

constexpr int kGzipWindow = 15 + 16;  // the largest window; 16: a gzip header is expected

struct InflateEnd {
  void operator()(z_stream* stream) const { inflateEnd(stream); }
};

}  // namespace

bool is_gzip(std::string_view bytes) { return bytes.starts_with("\x1F\x8B"); }

std::string unpack_gzip(std::string_view bytes, const std::string& source) {
  z_stream stream{};
  if (inflateInit2(&stream, kGzipWindow) != Z_OK) throw LibraryError("zlib cannot be initialised");
  const std::unique_ptr<z_stream, InflateEnd> owner(&stream);
  std::string text;
  std::array<char, 1 << 16> buffer{};
  int status = Z_OK;
  while (true) {
    if (stream.avail_in == 0) {
      const std::size_t taken = std::min<std::size_t>(bytes.size(), std::numeric_limits<uInt>::max());
      stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
      stream.avail_in = static_cast<uInt>(taken);
      bytes.remove_prefix(taken);
    }
    if (status == Z_STREAM_END) {
      if (stream.avail_in == 0) break;
      inflateReset(&stream);  // another file follows
    }
    stream.next_out = reinterpret_cast<Bytef*>(buffer.data());
    stream.avail_out = static_cast<uInt>(buffer.size());
    status = inflate(&stream, Z_NO_FLUSH);
    if (status == Z_BUF_ERROR) {
      throw InputError(fmt::format("{}: the compressed data end too early; the file is truncated", source));
    }
    if (status != Z_OK && status != Z_STREAM_END) {
      throw InputError(fmt::format("{}: the compressed data are damaged{}", source,
                                   stream.msg == nullptr ? "" : fmt::format(" ({})", stream.msg)));
    }
    text.append(buffer.data(), buffer.size() - stream.avail_out);
  }
  return text;
}

}  // namespace indet
