#include "dsl/closest.h"

#include <algorithm>

namespace rg::dsl {
namespace {

// Insertions, deletions, substitutions and swaps of neighbours count one each (optimal string alignment).
uint32_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<uint32_t>> cost(a.size() + 1, std::vector<uint32_t>(b.size() + 1));
  for (uint32_t i = 0; i <= a.size(); ++i) cost[i][0] = i;
  for (uint32_t j = 0; j <= b.size(); ++j) cost[0][j] = j;
  for (size_t i = 1; i <= a.size(); ++i)
    for (size_t j = 1; j <= b.size(); ++j) {
      cost[i][j] = std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, cost[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
    }
  return cost[a.size()][b.size()];
}

std::string sorted_letters(std::string_view word) {
  std::string letters(word);
  for (char& c : letters)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  std::sort(letters.begin(), letters.end());
  return letters;
}

}  // namespace

std::string Guess::shown() const {
  constexpr size_t kMost = 3;
  std::string text;
  for (size_t i = 0; i < std::min(words.size(), kMost); ++i) text += (i > 0 ? "` or `" : "") + words[i];
  return text;
}

Guess closest(std::string_view word, const std::vector<std::string_view>& candidates) {
  constexpr size_t kLongest = 64;
  if (word.size() > kLongest) return {};
  uint32_t best = static_cast<uint32_t>(std::max<size_t>(1, word.size() / 3)) + 1;
  std::vector<std::string_view> nearest;
  for (const std::string_view candidate : candidates) {
    if (candidate.size() > word.size() + best || candidate.size() + best < word.size() || candidate == word) continue;
    const uint32_t distance = edit_distance(word, candidate);
    if (distance > best || (distance == best && nearest.empty())) continue;
    if (distance < best) nearest.clear();
    best = distance;
    if (std::find(nearest.begin(), nearest.end(), candidate) == nearest.end()) nearest.push_back(candidate);
  }
  // What was left out is likelier than what is too much.
  std::stable_sort(nearest.begin(), nearest.end(), [](std::string_view a, std::string_view b) { return a.size() > b.size(); });
  return {{nearest.begin(), nearest.end()}, nearest.size() == 1};
}

Guess closest_type(std::string_view word, const std::vector<std::string_view>& candidates) {
  Guess guess = closest(word, candidates);
  guess.certain = guess.certain && sorted_letters(word) == sorted_letters(guess.words[0]);
  return guess;
}

void suggest(Diagnostic& diagnostic, Span span, const Guess& guess) {
  if (guess.words.empty()) return;
  if (guess.certain) return void(diagnostic.fix(span, guess.words[0]));
  diagnostic.note(DiagnosticKind::DidYouMean, span, {guess.shown()});
}

}  // namespace rg::dsl
