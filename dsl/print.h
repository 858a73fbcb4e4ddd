// Tokens, trees and programs as text: what `rgc emit` shows and golden files hold. Same value, same bytes.
#pragma once

#include <string>
#include <string_view>

#include "dsl/ast.h"
#include "dsl/program.h"
#include "dsl/token.h"

namespace rg::dsl {

std::string print_tokens(std::string_view text, const Tokens& tokens);  // line:column kind spelling
std::string print_tree(const ast::File& file);                          // nested (node ...) lists
std::string print_program(const Program& program);                      // one line a row, names instead of ids
std::string print_expr(const Program& program, ExprId id);              // `ceil(view.x / 8) * 2`
std::string print_type(const Program& program, const Type& type);
const char* print_role(Role role);

}  // namespace rg::dsl
