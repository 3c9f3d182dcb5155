#include "support/software_gl.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <array>
#include <cstring>
#include <stdexcept>

namespace plumb::test_support {
namespace {

// Window to clip space with y kept downwards: read from the lowest row, the image is top down, and
// its edges follow the top-left rule.
constexpr const char* kVertexShader = R"(#version 450 core
layout(location = 0) in vec3 corner;
layout(location = 0) uniform vec2 half_size;
void main() {
  precise vec2 clip = corner.xy / half_size - 1.0;
  gl_Position = vec4(clip, corner.z, 1.0);
}
)";
constexpr const char* kFragmentShader = R"(#version 450 core
layout(location = 0) out uint triangle;
void main() { triangle = uint(gl_PrimitiveID) + 1u; }
)";

EGLDisplay software_display() {
  std::array<EGLDeviceEXT, 16> devices;
  EGLint count = 0;
  if (!eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count))
    return EGL_NO_DISPLAY;
  for (EGLint k = 0; k < count; ++k) {
    const EGLDeviceEXT device = devices[static_cast<std::size_t>(k)];
    const char* extensions = eglQueryDeviceStringEXT(device, EGL_EXTENSIONS);
    if (extensions != nullptr && std::strstr(extensions, "EGL_MESA_device_software") != nullptr)
      return eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
  }
  return EGL_NO_DISPLAY;
}

GLuint compile(GLenum kind, const char* text) {
  const GLuint shader = glCreateShader(kind);
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint good = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (!good) throw std::runtime_error("a shader of the test does not compile");
  return shader;
}

}  // namespace

struct SoftwareGl::State {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
  GLuint program = 0, corners = 0, indices = 0, array = 0;
  GLsizei count = 0;
};

std::unique_ptr<SoftwareGl> SoftwareGl::create(std::string& why_not) {
  const auto state = std::make_shared<State>();
  state->display = software_display();
  if (state->display == EGL_NO_DISPLAY || !eglInitialize(state->display, nullptr, nullptr)) {
    why_not = "no software OpenGL driver (libgl1-mesa-dri)";
    return nullptr;
  }
  eglBindAPI(EGL_OPENGL_API);
  const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION, 4, EGL_CONTEXT_MINOR_VERSION, 5, EGL_NONE};
  state->context = eglCreateContext(state->display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted);
  if (state->context == EGL_NO_CONTEXT ||
      !eglMakeCurrent(state->display, EGL_NO_SURFACE, EGL_NO_SURFACE, state->context)) {
    why_not = "the software OpenGL driver gives no 4.5 context";
    return nullptr;
  }
  state->program = glCreateProgram();
  glAttachShader(state->program, compile(GL_VERTEX_SHADER, kVertexShader));
  glAttachShader(state->program, compile(GL_FRAGMENT_SHADER, kFragmentShader));
  glLinkProgram(state->program);
  glCreateVertexArrays(1, &state->array);
  std::unique_ptr<SoftwareGl> gl(new SoftwareGl);
  gl->state_ = std::make_unique<State>(*state);
  return gl;
}

SoftwareGl::~SoftwareGl() {
  if (!state_) return;
  eglMakeCurrent(state_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(state_->display, state_->context);
  eglTerminate(state_->display);
}

std::string SoftwareGl::renderer() const {
  return reinterpret_cast<const char*>(glGetString(GL_RENDERER));
}

void SoftwareGl::load(std::span<const WindowCorner> corners,
                      std::span<const std::uint32_t> indices) {
  glDeleteBuffers(1, &state_->corners);
  glDeleteBuffers(1, &state_->indices);
  glCreateBuffers(1, &state_->corners);
  glNamedBufferStorage(state_->corners, static_cast<GLsizeiptr>(corners.size_bytes()),
                       corners.data(), 0);
  glCreateBuffers(1, &state_->indices);
  glNamedBufferStorage(state_->indices, static_cast<GLsizeiptr>(indices.size_bytes()),
                       indices.data(), 0);
  state_->count = static_cast<GLsizei>(indices.size());
  glVertexArrayVertexBuffer(state_->array, 0, state_->corners, 0, sizeof(WindowCorner));
  glVertexArrayElementBuffer(state_->array, state_->indices);
  glEnableVertexArrayAttrib(state_->array, 0);
  glVertexArrayAttribFormat(state_->array, 0, 3, GL_FLOAT, GL_FALSE, 0);
  glVertexArrayAttribBinding(state_->array, 0, 0);
}

std::vector<std::uint32_t> SoftwareGl::draw(int width_px, int height_px, bool depth_test) {
  std::array<GLuint, 2> buffers{};
  glCreateRenderbuffers(2, buffers.data());
  glNamedRenderbufferStorage(buffers[0], GL_R32UI, width_px, height_px);
  glNamedRenderbufferStorage(buffers[1], GL_DEPTH_COMPONENT32F, width_px, height_px);
  GLuint frame = 0;
  glCreateFramebuffers(1, &frame);
  glNamedFramebufferRenderbuffer(frame, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffers[0]);
  glNamedFramebufferRenderbuffer(frame, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, buffers[1]);
  glBindFramebuffer(GL_FRAMEBUFFER, frame);
  const GLuint nothing[4] = {0, 0, 0, 0};
  const GLfloat far = 1.0f;
  glClearNamedFramebufferuiv(frame, GL_COLOR, 0, nothing);
  glClearNamedFramebufferfv(frame, GL_DEPTH, 0, &far);
  glViewport(0, 0, width_px, height_px);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  depth_test ? glEnable(GL_DEPTH_TEST) : glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glUseProgram(state_->program);
  glUniform2f(0, static_cast<float>(width_px) / 2.0f, static_cast<float>(height_px) / 2.0f);
  glBindVertexArray(state_->array);
  glDrawElements(GL_TRIANGLES, state_->count, GL_UNSIGNED_INT, nullptr);
  std::vector<std::uint32_t> image(static_cast<std::size_t>(width_px) *
                                   static_cast<std::size_t>(height_px));
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(0, 0, width_px, height_px, GL_RED_INTEGER, GL_UNSIGNED_INT, image.data());
  if (glGetError() != GL_NO_ERROR) throw std::runtime_error("OpenGL failed while drawing");
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glDeleteFramebuffers(1, &frame);
  glDeleteRenderbuffers(2, buffers.data());
  return image;
}

}  // namespace plumb::test_support
