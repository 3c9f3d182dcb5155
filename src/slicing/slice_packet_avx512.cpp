#include "core/lanes_avx512.h"
#include "slicing/slice_packet_kernel.h"

namespace plumb::slicing {

void slice_packet_avx512(const PacketScene& scene, SlicePacket& packet) {
  slice_packet_of<Avx512Lanes>(scene, packet);
}

}  // namespace plumb::slicing
