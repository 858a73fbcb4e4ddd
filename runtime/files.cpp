#include "runtime/files.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <system_error>

namespace rg {

namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

// errno, 0: written.
int write_all(int descriptor, std::span<const std::span<const std::byte>> parts) {
  File file(fdopen(descriptor, "wb"));
  if (!file) {
    const int why = errno;
    close(descriptor);
    return why;
  }
  for (const std::span<const std::byte> part : parts)
    if (std::fwrite(part.data(), 1, part.size(), file.get()) != part.size()) return errno;
  return std::fclose(file.release()) == 0 ? 0 : errno;
}

}  // namespace

Result<std::vector<std::byte>> read_file(const std::string& path, size_t most, std::string_view kind) {
  const auto fail = [&](const std::string& what) { return Error{ErrorCode::io, "`" + path + "` " + what}; };
  struct stat about {};
  if (::stat(path.c_str(), &about) != 0) return fail("cannot be found");
  if (!S_ISREG(about.st_mode)) return fail("is not a file");
  const File file(std::fopen(path.c_str(), "rb"));
  if (!file) return fail("cannot be opened");
  if (static_cast<uint64_t>(about.st_size) > most)
    return fail("is larger than " + std::to_string(most >> 20) + " MiB; that is no " + std::string(kind));
  std::vector<std::byte> bytes(static_cast<size_t>(about.st_size));
  bytes.resize(std::fread(bytes.data(), 1, bytes.size(), file.get()));
  if (std::ferror(file.get()) != 0) return fail("cannot be read");
  return bytes;
}

Status replace_file(const std::string& path, std::span<const std::span<const std::byte>> parts) {
  std::string temporary = path + '.' + std::string(6, 'X');
  const int descriptor = mkstemp(temporary.data());
  int why = descriptor < 0 ? errno : write_all(descriptor, parts);
  if (why == 0 && std::rename(temporary.c_str(), path.c_str()) != 0) why = errno;
  if (why == 0) return Done{};
  if (descriptor >= 0) unlink(temporary.c_str());
  return Error{ErrorCode::io, "`" + path + "` cannot be written: " + std::generic_category().message(why)};
}

}  // namespace rg
