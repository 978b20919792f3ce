#include "indet/io/global_heap.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <vector>

namespace indet {
namespace {

constexpr std::size_t kWord = 8;     // objects of a heap begin at multiples of it
constexpr std::size_t kHeader = 16;  // of a heap, and of an object
constexpr std::size_t kBlock = 1 << 20;
constexpr char kSignature[kWord] = {'G', 'C', 'O', 'L', 1, 0, 0, 0};

std::uint64_t number_at(const std::vector<char>& bytes, std::size_t place, std::size_t length) {
  std::uint64_t number = 0;
  for (std::size_t k = length; k-- > 0;) number = number << 8 | static_cast<unsigned char>(bytes[place + k]);
  return number;
}

/// Walks over the objects of a heap; `bytes` is all of it.
bool is_sound(const std::vector<char>& bytes) {
  std::size_t place = kHeader;
  while (bytes.size() - place >= kHeader) {
    const std::uint64_t index = number_at(bytes, place, 2);
    const std::uint64_t size = number_at(bytes, place + kWord, kWord);
    const std::uint64_t left = bytes.size() - place;
    if (size > left) return false;
    // The free space at the end counts its own header.
    const std::uint64_t length = index == 0 ? size : kHeader + (size + kWord - 1) / kWord * kWord;
    if (length < kHeader || length > left) return false;
    place += length;
  }
  return true;
}

}  // namespace

std::optional<std::uint64_t> find_damaged_heap(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) return {};
  const auto file_size = static_cast<std::uint64_t>(file.tellg());
  std::vector<char> block(kBlock);
  // Blocks overlap by a header, so that none is cut in two.
  for (std::uint64_t begin = 0; begin < file_size; begin += kBlock - kHeader) {
    file.seekg(static_cast<std::streamoff>(begin));
    file.read(block.data(), kBlock);
    const char* const end = block.data() + file.gcount();
    file.clear();
    const auto next = [&](const char* from) {
      return std::search(from, const_cast<const char*>(end), std::begin(kSignature), std::end(kSignature));
    };
    for (const char* found = next(block.data()); end - found >= static_cast<std::ptrdiff_t>(kHeader);
         found = next(found + 1)) {
      const auto offset = static_cast<std::size_t>(found - block.data());
      const std::uint64_t place = begin + offset;
      const std::uint64_t size = number_at(block, offset + kWord, kWord);
      if (size < kHeader || size > file_size - place) return place;
      std::vector<char> heap(size);
      file.seekg(static_cast<std::streamoff>(place));
      file.read(heap.data(), static_cast<std::streamsize>(size));
      file.clear();
      if (!is_sound(heap)) return place;
    }
  }
  return {};
}

}  // namespace indet
