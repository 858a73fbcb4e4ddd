// TOKENS -> TREE. Recovers at the next statement or declaration: one mistake gives one message.
#pragma once

#include "dsl/ast.h"
#include "dsl/diagnostics.h"
#include "dsl/token.h"

namespace rg::dsl {

ast::File parse(FileId file, std::string_view text, const Tokens& tokens, Diagnostics& diagnostics);

}  // namespace rg::dsl
