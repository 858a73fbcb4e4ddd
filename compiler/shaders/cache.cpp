#include "compiler/shaders/cache.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

namespace rg::compiler {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kMagic = "rgc-cache-1\n";
constexpr size_t kKeyBytes = 32, kSizeBytes = 8, kHeaderBytes = 12 + kKeyBytes + kSizeBytes;
constexpr uint64_t kMaxEntryBytes = uint64_t{1} << 28;
constexpr time_t kAbandonedSeconds = 3600;  // a temporary file this old has no writer any more

class File {
 public:
  File(const std::string& path, int flags) : number_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {}
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  ~File() {
    if (number_ >= 0) ::close(number_);
  }
  bool good() const { return number_ >= 0; }
  int number() const { return number_; }

 private:
  int number_;
};

std::optional<std::string> read_whole(const std::string& path) {
  const File file(path, O_RDONLY | O_NONBLOCK | O_NOFOLLOW);
  struct stat about {};
  if (!file.good() || ::fstat(file.number(), &about) != 0 || !S_ISREG(about.st_mode)) return std::nullopt;
  if (static_cast<uint64_t>(about.st_size) > kMaxEntryBytes) return std::string();
  std::string text(static_cast<size_t>(about.st_size), '\0');
  size_t done = 0;
  while (done < text.size()) {
    const ssize_t got = ::read(file.number(), text.data() + done, text.size() - done);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    done += static_cast<size_t>(got);
  }
  text.resize(done);
  return text;
}

bool write_whole(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t got = ::write(file, text.data(), text.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return false;
    text.remove_prefix(static_cast<size_t>(got));
  }
  return true;
}

std::string_view view_of(const Digest& digest) { return {reinterpret_cast<const char*>(digest.bytes.data()), digest.bytes.size()}; }

std::string number_text(uint64_t number) {
  std::string text(8, '\0');
  for (size_t i = 0; i < 8; ++i) text[i] = static_cast<char>(number >> (8 * i));
  return text;
}
uint64_t number_of(std::string_view text) {
  uint64_t number = 0;
  for (size_t i = 0; i < 8; ++i) number |= uint64_t{static_cast<uint8_t>(text[i])} << (8 * i);
  return number;
}

std::string entry_text(const Digest& key, const std::string& payload) {
  std::string text = std::string(kMagic) + std::string(view_of(key)) + number_text(payload.size()) + payload;
  text += view_of(Sha256().add(text).finish());
  return text;
}

// The payload, if `text` is a whole entry of that key.
std::optional<std::string_view> payload_of(std::string_view text, const Digest& key) {
  if (text.size() < kHeaderBytes + kKeyBytes || !text.starts_with(kMagic)) return std::nullopt;
  const std::string_view body = text.substr(0, text.size() - kKeyBytes);
  if (text.substr(kMagic.size(), kKeyBytes) != view_of(key)) return std::nullopt;
  if (number_of(text.substr(kMagic.size() + kKeyBytes)) != body.size() - kHeaderBytes) return std::nullopt;
  if (view_of(Sha256().add(body).finish()) != text.substr(body.size())) return std::nullopt;
  return body.substr(kHeaderBytes);
}

struct Entry {
  fs::path path;
  uint64_t bytes = 0;
  int64_t used = 0;  // nanoseconds
};

bool is_temporary(const fs::path& path) { return path.filename().string().starts_with(".tmp."); }

// Entries below `folder`; abandoned temporary files are removed on the way.
std::vector<Entry> list_entries(const std::string& folder) {
  std::vector<Entry> entries;
  std::error_code error;
  const time_t now = ::time(nullptr);
  for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    struct stat about {};
    if (::lstat(at->path().c_str(), &about) != 0 || !S_ISREG(about.st_mode) || at->path().filename() == "lock") continue;
    if (is_temporary(at->path())) {
      if (about.st_mtime + kAbandonedSeconds < now) ::unlink(at->path().c_str());
      continue;
    }
    entries.push_back({at->path(), static_cast<uint64_t>(about.st_size), int64_t{about.st_mtim.tv_sec} * 1'000'000'000 + about.st_mtim.tv_nsec});
  }
  return entries;
}

}  // namespace

std::string encode_modules(const std::vector<Words>& modules) {
  std::string text = number_text(modules.size());
  for (const Words& words : modules) {
    text += number_text(words.size());
    text.append(reinterpret_cast<const char*>(words.data()), words.size() * sizeof(uint32_t));
  }
  return text;
}

std::optional<std::vector<Words>> decode_modules(std::string_view payload) {
  if (payload.size() < kSizeBytes) return std::nullopt;
  const uint64_t count = number_of(payload);
  payload.remove_prefix(kSizeBytes);
  std::vector<Words> modules;
  for (uint64_t i = 0; i < count; ++i) {
    if (payload.size() < kSizeBytes) return std::nullopt;
    const uint64_t size = number_of(payload);
    payload.remove_prefix(kSizeBytes);
    if (size > payload.size() / sizeof(uint32_t)) return std::nullopt;
    Words words(size);
    if (size > 0) std::memcpy(words.data(), payload.data(), size * sizeof(uint32_t));
    payload.remove_prefix(size * sizeof(uint32_t));
    modules.push_back(std::move(words));
  }
  if (!payload.empty()) return std::nullopt;
  return modules;
}

ShaderCache::ShaderCache(std::string folder, uint64_t limit_bytes) : folder_(std::move(folder)), limit_bytes_(limit_bytes) {}

std::string ShaderCache::path_of(const Digest& key) const {
  const std::string name = hex(key);
  return folder_ + "/" + name.substr(0, 2) + "/" + name;
}

std::optional<std::vector<Words>> ShaderCache::find(const Digest& key) const {
  const std::string path = path_of(key);
  const auto text = read_whole(path);
  if (!text) {
    ++misses_;
    return std::nullopt;
  }
  const auto payload = payload_of(*text, key);
  auto modules = payload ? decode_modules(*payload) : std::nullopt;
  if (!modules) {
    ++damaged_;
    ::unlink(path.c_str());
    return std::nullopt;
  }
  ++hits_;
  ::utimensat(AT_FDCWD, path.c_str(), nullptr, 0);  // used now: trim() takes others first
  return modules;
}

void ShaderCache::store(const Digest& key, const std::vector<Words>& modules) const {
  static std::atomic<uint64_t> next = 0;
  const std::string path = path_of(key), parent = fs::path(path).parent_path();
  const std::string temporary = parent + "/.tmp." + std::to_string(::getpid()) + "." + std::to_string(next++);
  std::error_code error;
  fs::create_directories(parent, error);
  bool written = false;
  {
    const File file(temporary, O_WRONLY | O_CREAT | O_EXCL);
    written = file.good() && write_whole(file.number(), entry_text(key, encode_modules(modules)));
  }
  if (written && ::rename(temporary.c_str(), path.c_str()) == 0) {
    ++stored_;
    return;
  }
  ::unlink(temporary.c_str());
  ++failed_;
}

void ShaderCache::trim() const {
  const File lock(folder_ + "/lock", O_RDWR | O_CREAT);
  if (!lock.good() || ::flock(lock.number(), LOCK_EX | LOCK_NB) != 0) return;
  std::vector<Entry> entries = list_entries(folder_);
  uint64_t total = 0;
  for (const Entry& entry : entries) total += entry.bytes;
  if (total <= limit_bytes_) return;
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return std::tie(a.used, a.path) < std::tie(b.used, b.path); });
  for (const Entry& entry : entries) {
    if (total <= limit_bytes_ / 10 * 9) return;
    if (::unlink(entry.path.c_str()) == 0) total -= entry.bytes;
  }
}

ShaderCache::Counts ShaderCache::counts() const { return {hits_, misses_, damaged_, stored_, failed_}; }

}  // namespace rg::compiler
