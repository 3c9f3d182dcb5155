#include "core/lanes_sse2.h"
#include "slicing/slice_packet_kernel.h"

namespace plumb::slicing {

void slice_packet_sse2(const PacketScene& scene, SlicePacket& packet) {
  slice_packet_of<Sse2Lanes>(scene, packet);
}

}  // namespace plumb::slicing
