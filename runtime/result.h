// Failures of the world are values: a code and one line that says what failed, on what, and the way out.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <variant>

namespace rg {

enum class ErrorCode : uint8_t { unsupported, out_of_memory, device_lost, out_of_date, invalid_plan, invalid_argument, io, driver };
struct Error {
  ErrorCode code = ErrorCode::driver;
  std::string message;
};

template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::move(value)) {}
  Result(Error error) : state_(std::move(error)) {}
  explicit operator bool() const { return std::holds_alternative<T>(state_); }
  T& operator*() { return std::get<T>(state_); }
  const T& operator*() const { return std::get<T>(state_); }
  T* operator->() { return &std::get<T>(state_); }
  const T* operator->() const { return &std::get<T>(state_); }
  const Error& error() const { return std::get<Error>(state_); }

 private:
  std::variant<T, Error> state_;
};

struct Done {};
using Status = Result<Done>;

}  // namespace rg
