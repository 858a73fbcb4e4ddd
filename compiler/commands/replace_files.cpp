#include "compiler/commands/replace_files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

namespace rg::commands {
namespace {

namespace fs = std::filesystem;
using dsl::DiagnosticKind;

class NewFile {
 public:
  explicit NewFile(const fs::path& path) : number_(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666)) {}
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;
  ~NewFile() {
    if (number_ >= 0) ::close(number_);
  }
  int number() const { return number_; }
  bool close() { return ::close(std::exchange(number_, -1)) == 0; }  // the last chance to learn that a write failed

 private:
  int number_;
};

// Owner and mode of the file that `number` takes the place of, as far as they can be had.
void take_after(const fs::path& old, int number) {
  struct stat before {
  }, now{};
  if (::lstat(old.c_str(), &before) != 0 || !S_ISREG(before.st_mode) || ::fstat(number, &now) != 0) return;
  const bool same = before.st_uid == now.st_uid && before.st_gid == now.st_gid;
  const bool own = same || ::fchown(number, before.st_uid, before.st_gid) == 0;
  ::fchmod(number, before.st_mode & (own ? 07777 : 0777));
}

// errno of what failed, or 0.
int write_new(const fs::path& path, const std::string& text, const fs::path& old) {
  NewFile file(path);
  if (file.number() < 0) return errno;
  take_after(old, file.number());
  for (size_t done = 0; done < text.size();) {
    const ssize_t got = ::write(file.number(), text.data() + done, text.size() - done);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return errno;
    done += static_cast<size_t>(got);
  }
  return file.close() ? 0 : errno;
}

// Short, whatever the file is called: a name has a limit.
fs::path beside(const fs::path& path, size_t number, const char* ending) {
  return path.parent_path() / (".rgc." + std::to_string(::getpid()) + "." + std::to_string(number) + ending);
}

}  // namespace

std::string reason(int error) {
  switch (error) {
    case ENOENT:
      return "no such file";
    case EISDIR:
      return "it is a folder";
    case ENOTDIR:
      return "a part of the path is not a folder";
    case EACCES:
    case EPERM:
      return "permission denied";
    case ENOSPC:
    case EDQUOT:
      return "the disk is full";
    case EFBIG:
      return "a file size limit is reached";
    case EROFS:
      return "the file system is read-only";
    case ENAMETOOLONG:
      return "a name in the path is longer than the file system takes";
    case ELOOP:
      return "symbolic links lead in a circle";
    default:
      return std::strerror(error);
  }
}

fs::path target_of(const fs::path& path) {
  constexpr int kMostLinks = 40;  // as Linux has it
  std::error_code error;
  fs::path at = path;
  for (int i = 0; i < kMostLinks; ++i) {
    const fs::path next = fs::read_symlink(at, error);
    if (error) return at;  // no link
    at = next.is_absolute() ? next : at.parent_path() / next;
  }
  return path;
}

// The bits count for root too, whom nothing else would stop.
std::string why_not_replaced(const fs::path& path) {
  struct stat about {};
  if (::stat(path.c_str(), &about) != 0) return errno == ENOENT ? "" : reason(errno);
  if (S_ISDIR(about.st_mode)) return reason(EISDIR);
  if (!S_ISREG(about.st_mode)) return "it is not a regular file";
  if ((about.st_mode & (S_IWUSR | S_IWGRP | S_IWOTH)) == 0) return "it is read-only";
  return ::faccessat(AT_FDCWD, path.c_str(), W_OK, AT_EACCESS) == 0 ? "" : reason(errno);
}

FileReplacements::~FileReplacements() {
  std::error_code ignored;
  for (const File& file : files_) {
    fs::remove(file.temporary, ignored);
    if (!file.old.empty()) fs::remove(file.old, ignored);
  }
  for (size_t i = folders_.size(); !committed_ && i-- > 0;) ::rmdir(folders_[i].c_str());  // only if it is empty
}

int FileReplacements::make_folder(const fs::path& folder) {
  std::error_code error;
  if (folder.empty() || fs::is_directory(folder, error)) return 0;
  if (const int failed = make_folder(folder.parent_path())) return failed;
  if (fs::create_directory(folder, error)) folders_.push_back(folder);
  return error.value() == EEXIST ? ENOTDIR : error.value();
}

bool FileReplacements::prepare(const fs::path& path, const std::string& text, dsl::Diagnostics& diagnostics) {
  const fs::path temporary = beside(path, files_.size(), ".tmp");
  const auto why = [](int failed) { return failed == 0 ? "" : failed == ENOENT ? "its folder cannot be made" : reason(failed); };
  std::string problem = why(make_folder(path.parent_path()));
  if (problem.empty()) problem = why_not_replaced(path);
  if (problem.empty()) {
    files_.push_back({path, temporary, {}, File::Before::nothing});
    problem = why(write_new(temporary, text, path));
  }
  if (!problem.empty()) diagnostics.report(DiagnosticKind::OutputNotWritable, {}, {path.string(), problem, "nothing was changed"});
  return problem.empty();
}

// Puts the first `done` files back and says how that went.
std::string FileReplacements::undo(size_t done) {
  size_t left = 0;
  for (size_t i = done; i-- > 0;) {
    File& file = files_[i];
    const bool back = file.before == File::Before::nothing ? ::unlink(file.path.c_str()) == 0
                                                           : file.before == File::Before::kept && ::rename(file.old.c_str(), file.path.c_str()) == 0;
    left += !back;
  }
  return left == 0 ? "nothing was changed" : fmt::format("{} of the other files are new already and could not be put back", left);
}

bool FileReplacements::commit(dsl::Diagnostics& diagnostics) {
  for (size_t i = 0; i < files_.size(); ++i) {
    File& file = files_[i];
    const fs::path old = beside(file.path, i, ".old");
    ::unlink(old.c_str());
    if (::link(file.path.c_str(), old.c_str()) == 0)
      file.old = old, file.before = File::Before::kept;
    else if (errno != ENOENT)
      file.before = File::Before::lost;
    if (::rename(file.temporary.c_str(), file.path.c_str()) == 0) continue;
    const int failed = errno;
    diagnostics.report(DiagnosticKind::OutputNotWritable, {}, {file.path.string(), reason(failed), undo(i)});
    return false;
  }
  committed_ = true;
  return true;
}

}  // namespace rg::commands
