#include "compiler/shaders/sha256_blocks.h"

#include <bit>
#include <cstring>

#if defined(__x86_64__) && defined(__GNUC__)
#define RG_SHA_X86 1
#include <cpuid.h>
#include <immintrin.h>
#endif

namespace rg::compiler {
namespace {

// First 32 bits of the fractional parts of the cube roots of the first 64 primes.
alignas(16) constexpr uint32_t kRound[64] = {
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5, 0xd807aa98, 0x12835b01, 0x243185be,
    0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174, 0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa,
    0x5cb0a9dc, 0x76f988da, 0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967, 0x27b70a85,
    0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85, 0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3,
    0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070, 0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f,
    0x682e6ff3, 0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

uint32_t big_endian(const uint8_t* p) { return uint32_t{p[0]} << 24 | uint32_t{p[1]} << 16 | uint32_t{p[2]} << 8 | p[3]; }

void portable_block(Sha256State& state, const uint8_t* data) {
  uint32_t w[64];
  for (int i = 0; i < 16; ++i) w[i] = big_endian(data + 4 * i);
  for (int i = 16; i < 64; ++i) {
    const uint32_t s0 = std::rotr(w[i - 15], 7) ^ std::rotr(w[i - 15], 18) ^ (w[i - 15] >> 3);
    const uint32_t s1 = std::rotr(w[i - 2], 17) ^ std::rotr(w[i - 2], 19) ^ (w[i - 2] >> 10);
    w[i] = w[i - 16] + s0 + w[i - 7] + s1;
  }
  auto [a, b, c, d, e, f, g, h] = state;
  for (int i = 0; i < 64; ++i) {
    const uint32_t s1 = std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25);
    const uint32_t first = h + s1 + ((e & f) ^ (~e & g)) + kRound[i] + w[i];
    const uint32_t s0 = std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22);
    const uint32_t second = s0 + ((a & b) ^ (a & c) ^ (b & c));
    h = g, g = f, f = e, e = d + first, d = c, c = b, b = a, a = first + second;
  }
  const uint32_t sums[] = {a, b, c, d, e, f, g, h};
  for (size_t i = 0; i < 8; ++i) state[i] += sums[i];
}

#ifdef RG_SHA_X86
#define RG_SHA_TARGET __attribute__((target("sha,sse4.1,ssse3")))

// The instructions hold the state as the two vectors (f e b a) and (h g d c), lowest lane first.
struct Halves {
  __m128i feba, hgdc;
};

RG_SHA_TARGET inline Halves load_state(const Sha256State& state) {
  const __m128i cdab = _mm_shuffle_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(&state[0])), 0xb1);
  const __m128i efgh = _mm_shuffle_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(&state[4])), 0x1b);
  return {_mm_alignr_epi8(cdab, efgh, 8), _mm_blend_epi16(efgh, cdab, 0xf0)};
}

RG_SHA_TARGET inline void store_state(const Halves& halves, Sha256State& state) {
  const __m128i abef = _mm_shuffle_epi32(halves.feba, 0x1b), ghcd = _mm_shuffle_epi32(halves.hgdc, 0xb1);
  _mm_storeu_si128(reinterpret_cast<__m128i*>(&state[0]), _mm_blend_epi16(abef, ghcd, 0xf0));
  _mm_storeu_si128(reinterpret_cast<__m128i*>(&state[4]), _mm_alignr_epi8(ghcd, abef, 8));
}

RG_SHA_TARGET void native_block(Halves& state, const uint8_t* data) {
  const __m128i reverse = _mm_set_epi64x(0x0c0d0e0f08090a0bll, 0x0405060700010203ll);  // of the bytes of each word
  __m128i w[4];                                                                        // the last sixteen words of the schedule
  for (int i = 0; i < 4; ++i) w[i] = _mm_shuffle_epi8(_mm_loadu_si128(reinterpret_cast<const __m128i*>(data + 16 * i)), reverse);
  Halves s = state;
#pragma GCC unroll 16
  for (int i = 0; i < 16; ++i) {  // four rounds each
    const __m128i sum = _mm_add_epi32(w[i % 4], _mm_load_si128(reinterpret_cast<const __m128i*>(kRound + 4 * i)));
    s.hgdc = _mm_sha256rnds2_epu32(s.hgdc, s.feba, sum);
    s.feba = _mm_sha256rnds2_epu32(s.feba, s.hgdc, _mm_shuffle_epi32(sum, 0x0e));
    const __m128i &last = w[(i + 3) % 4], &middle = w[(i + 2) % 4];
    const __m128i extended = _mm_add_epi32(_mm_sha256msg1_epu32(w[i % 4], w[(i + 1) % 4]), _mm_alignr_epi8(last, middle, 4));
    w[i % 4] = _mm_sha256msg2_epu32(extended, last);
  }
  state = {_mm_add_epi32(state.feba, s.feba), _mm_add_epi32(state.hgdc, s.hgdc)};
}

RG_SHA_TARGET void native_blocks(Sha256State& state, const uint8_t* data, size_t blocks) {
  Halves halves = load_state(state);
  for (size_t i = 0; i < blocks; ++i) native_block(halves, data + 64 * i);
  store_state(halves, state);
}

bool has_instructions() {
  unsigned a = 0, b = 0, c = 0, d = 0;
  if (__get_cpuid(1, &a, &b, &c, &d) == 0 || (c & bit_SSE4_1) == 0 || (c & bit_SSSE3) == 0) return false;
  return __get_cpuid_count(7, 0, &a, &b, &c, &d) != 0 && (b & bit_SHA) != 0;
}
#endif

}  // namespace

void sha256_blocks_portable(Sha256State& state, const uint8_t* data, size_t blocks) {
  for (size_t i = 0; i < blocks; ++i) portable_block(state, data + 64 * i);
}

Sha256Blocks sha256_blocks_native() {
#ifdef RG_SHA_X86
  static const bool available = has_instructions();
  if (available) return native_blocks;
#endif
  return nullptr;
}

Sha256Blocks sha256_blocks() {
  const Sha256Blocks native = sha256_blocks_native();
  return native != nullptr ? native : sha256_blocks_portable;
}

}  // namespace rg::compiler
