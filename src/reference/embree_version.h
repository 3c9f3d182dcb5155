// Embree 3 or 4, whichever is there: the few names that differ. Included by source files alone.
//
// Tested with Embree 3.13. The Embree 4 half follows its documentation and has not been run.
#pragma once

#if __has_include(<embree4/rtcore.h>) && !__has_include(<embree3/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace plumb::reference {

#if RTC_VERSION_MAJOR >= 4

using EmbreeRayContext = RTCRayQueryContext;

/// For rays that go much the same way.
inline void start(EmbreeRayContext& context) { rtcInitRayQueryContext(&context); }

inline void intersect(RTCScene scene, EmbreeRayContext& context, const int* valid,
                      RTCRayHit16& rays) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &context;
  arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  rtcIntersect16(valid, scene, &rays, &arguments);
}

inline void intersect(RTCScene scene, EmbreeRayContext& context, RTCRayHit& ray) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &context;
  rtcIntersect1(scene, &ray, &arguments);
}

#else

using EmbreeRayContext = RTCIntersectContext;

inline void start(EmbreeRayContext& context) {
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
}

inline void intersect(RTCScene scene, EmbreeRayContext& context, const int* valid,
                      RTCRayHit16& rays) {
  rtcIntersect16(valid, scene, &context, &rays);
}

inline void intersect(RTCScene scene, EmbreeRayContext& context, RTCRayHit& ray) {
  rtcIntersect1(scene, &context, &ray);
}

#endif

}  // namespace plumb::reference
