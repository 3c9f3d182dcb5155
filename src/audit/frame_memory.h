// What a frame's pixels need, asked before work starts.
#pragma once

#include <cstdint>

#include "core/camera.h"

namespace plumb::audit {

/// Bytes a pixel: hits alone; hits, channels and colours of a picture and a file's copy of them;
/// the maps of an audit with two pictures' hits (150 bytes at the peak, measured on frames of 0.06
/// and 8.3 million pixels of three methods: 145 to 148).
inline constexpr std::int64_t kHitBytes = 38, kPictureBytes = 186, kAuditBytes = 150;
/// That of a depth buffer has the buffer, roundings and two more copies of its picture.
inline constexpr std::int64_t kDepthAuditBytes = kAuditBytes + 2 * kHitBytes + 14;
/// That of a frame of a path has places, what is drawn over them in three frames, and their maps.
inline constexpr std::int64_t kPathAuditBytes = kAuditBytes + 130;

/// Throws InputError, naming the size, what is needed and what is there, unless `bytes_per_pixel`
/// for every pixel of the camera fit into memory.
void require_frame_memory(const Camera& camera, std::int64_t bytes_per_pixel);

}  // namespace plumb::audit
