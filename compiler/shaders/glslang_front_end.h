// GLSL text to SPIR-V, by glslang in this process.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "compiler/shaders/sources.h"
#include "dsl/program.h"

namespace rg::compiler {

// Where glslang found fault: in the generated prelude (`file` empty), or in the shader or one of its includes. Lines count from 1; 0: no line.
struct ShaderMessage {
  std::string file;
  uint32_t line = 0;
  std::string text;          // "'foo' : undeclared identifier"
  std::string expands = {};  // the macro that becomes longer than kMostWords, instead of a text
  friend bool operator==(const ShaderMessage&, const ShaderMessage&) = default;
};

struct FrontEndOutput {
  std::vector<uint32_t> words;  // SPIR-V 1.5 for Vulkan 1.3, not optimised, with names; empty after an error
  std::vector<ShaderMessage> errors;
};

// Makes the tables that glslang makes once a process, so that the first shader need not wait for them.
void warm_front_end();

// Fails before glslang runs where macros or includes would make too much of the text, see expansion.h.
// `path` is relative to the root folder; `#include` looks beside the including file, then in the root folder. Thread-safe.
FrontEndOutput compile_glsl(dsl::Stage stage, const std::string& prelude, const std::string& path, const std::string& text, ShaderSources& sources);

}  // namespace rg::compiler
