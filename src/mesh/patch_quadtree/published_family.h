// Version 1 of the codec, as the paper has it: a family of four children, refined from their
// parent's numbers and foretold bilinearly. Source: [Yusov & Shevtsov 2011, section 4].
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "core/byte_stream.h"
#include "mesh/patch_quadtree/patch_numbers.h"

namespace plumb::mesh::patch_quadtree {

/// Children (0, 0), (1, 0), (0, 1), (1, 1) of a patch; those beyond the terrain are not there.
using Family = std::array<std::optional<PatchNumbers>, 4>;

/// The family's record. Numbers are those of a Quantiser whose step doubles with the level.
///
/// Even samples are refined: q - 2 q_parent, one of three symbols. The others are foretold as the
/// mean of the two or four refined ones beside them, (a + b + 1) >> 1 or (a + b + c + d + 2) >> 2,
/// and what is foretold less q is coded as a magnitude (255: Elias gamma of the rest follows) and,
/// above zero, a sign. All by adaptive models, one for each class of symbols, which begin anew with
/// every family.
Bytes encode_family(const PatchNumbers& parent, const Family& children);

/// The children that `there` says exist. False if the bytes are no such record.
bool decode_family(const PatchNumbers& parent, const std::array<bool, 4>& there,
                   std::span<const std::uint8_t> bytes, Family& children);

}  // namespace plumb::mesh::patch_quadtree
