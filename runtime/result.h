// Failures of the world are values: a code and one line that says what failed, on what, and the way out.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <variant>

namespace rg {

// What kind of failure it is: decides what a caller can do. `device_lost` is final, `out_of_date` wants another swapchain, the others leave things as
// they were.
enum class ErrorCode : uint8_t { unsupported, out_of_memory, device_lost, out_of_date, invalid_plan, invalid_argument, io, driver };
// A failure: what failed, on what, and the way out, in one line for a person.
struct Error {
  ErrorCode code = ErrorCode::driver;
  std::string message;
};

// A value, or why there is none. `*` and `->` need a value, error() needs an error; asking for the other throws std::bad_variant_access.
template <class T>
class [[nodiscard]] Result {
 public:
  // Success.
  Result(T value) : state_(std::move(value)) {}
  // Failure.
  Result(Error error) : state_(std::move(error)) {}
  explicit operator bool() const { return std::holds_alternative<T>(state_); }
  T& operator*() { return std::get<T>(state_); }
  const T& operator*() const { return std::get<T>(state_); }
  T* operator->() { return &std::get<T>(state_); }
  const T* operator->() const { return &std::get<T>(state_); }
  // Why there is no value.
  const Error& error() const { return std::get<Error>(state_); }

 private:
  std::variant<T, Error> state_;
};

struct Done {};
using Status = Result<Done>;  // of what gives nothing but may fail

}  // namespace rg
