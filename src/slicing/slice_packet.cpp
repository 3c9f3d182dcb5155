#include "slicing/slice_packet.h"

namespace plumb::slicing {

void slice_packet_sse2(const PacketScene& scene, SlicePacket& packet);
void slice_packet_avx2(const PacketScene& scene, SlicePacket& packet);
void slice_packet_avx512(const PacketScene& scene, SlicePacket& packet);

SlicePackets slice_packets(InstructionSet set) {
  return kernel_for(set, slice_packet_sse2, slice_packet_avx2, slice_packet_avx512);
}

}  // namespace plumb::slicing
