#include "examples/demo/png.h"

#include <cerrno>
#include <cstdio>
#include <cstring>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#include <stb_image_write.h>
#pragma GCC diagnostic pop

namespace rg::demo {
namespace {

Error failure(const std::filesystem::path& path, int number) {
  return {ErrorCode::io, "`" + path.string() + "` cannot be written: " + std::strerror(number) + "; choose another folder with --out"};
}

std::vector<uint8_t> encode(const Picture& picture) {
  std::vector<uint8_t> bytes;
  const auto append = [](void* context, void* data, int size) {
    auto& out = *static_cast<std::vector<uint8_t>*>(context);
    out.insert(out.end(), static_cast<uint8_t*>(data), static_cast<uint8_t*>(data) + size);
  };
  const int width = static_cast<int>(picture.width), height = static_cast<int>(picture.height);
  stbi_write_png_to_func(append, &bytes, width, height, 4, picture.texels.data(), width * 4);
  return bytes;
}

// 0, or errno of what failed; a full disk may be noticed as late as in fclose.
int write_all(const std::filesystem::path& path, const std::vector<uint8_t>& bytes) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) return errno;
  int problem = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size() ? 0 : errno;
  if (std::fflush(file) != 0 && problem == 0) problem = errno;
  if (std::fclose(file) != 0 && problem == 0) problem = errno;
  return problem;
}

}  // namespace

Status write_png(const std::filesystem::path& path, const Picture& picture) {
  std::filesystem::path temporary = path;
  temporary += ".tmp";
  std::error_code ignored;
  if (const int problem = write_all(temporary, encode(picture)); problem != 0) {
    std::filesystem::remove(temporary, ignored);
    return failure(path, problem);
  }
  std::error_code renamed;
  std::filesystem::rename(temporary, path, renamed);
  if (!renamed) return Done{};
  std::filesystem::remove(temporary, ignored);
  return failure(path, renamed.value());
}

}  // namespace rg::demo
