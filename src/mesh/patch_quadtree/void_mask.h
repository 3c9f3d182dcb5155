// Where there is no height, exactly.
#pragma once

#include <cstdint>
#include <span>

#include "core/byte_stream.h"
#include "core/grid.h"

namespace plumb::mesh::patch_quadtree {

/// Of a place of which the parent says nothing.
inline constexpr std::uint8_t kUnknownVoid = 2;

/// What a parent's mask (empty: no voids) says of child (s, t)'s, both of n cells: the parent's
/// samples, and kUnknownVoid between them.
Grid<std::uint8_t> known_voids(const Grid<std::uint8_t>& parent, int s, int t, int n);

/// Bytes of a mask (1: void), by an adaptive model of what lies to the left and below, and of what
/// `known` says of the place: 0 or 1 where the parent has the sample, which is not coded again,
/// kUnknownVoid where it has not. Both of one size.
Bytes encode_voids(const Grid<std::uint8_t>& mask, const Grid<std::uint8_t>& known);

/// The mask again; false if the bytes are none of its.
bool decode_voids(std::span<const std::uint8_t> bytes, const Grid<std::uint8_t>& known,
                  Grid<std::uint8_t>& mask);

}  // namespace plumb::mesh::patch_quadtree
