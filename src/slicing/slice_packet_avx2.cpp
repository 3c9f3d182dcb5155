#include "core/lanes_avx2.h"
#include "slicing/slice_packet_kernel.h"

namespace plumb::slicing {

void slice_packet_avx2(const PacketScene& scene, SlicePacket& packet) {
  slice_packet_of<Avx2Lanes>(scene, packet);
}

}  // namespace plumb::slicing
