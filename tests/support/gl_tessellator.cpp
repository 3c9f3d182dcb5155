#include "support/gl_tessellator.h"

#include <epoxy/gl.h>

#include <stdexcept>
#include <string>

namespace plumb::test_support {
namespace {

constexpr const char* kVertexShader = "#version 450 core\nvoid main() {}\n";
constexpr std::size_t kMostCorners = 3 * 8192;  // of a patch of factor 64
constexpr std::array<const char*, 3> kSpacings{"equal_spacing", "fractional_odd_spacing",
                                               "fractional_even_spacing"};

void attach(GLuint program, GLenum kind, const std::string& text) {
  const GLuint shader = glCreateShader(kind);
  const char* lines = text.c_str();
  glShaderSource(shader, 1, &lines, nullptr);
  glCompileShader(shader);
  glAttachShader(program, shader);
  glDeleteShader(shader);
}

GLuint make_program(const char* spacing, bool points) {
  const GLuint program = glCreateProgram();
  attach(program, GL_VERTEX_SHADER, kVertexShader);
  attach(program, GL_TESS_EVALUATION_SHADER,
         std::string("#version 450 core\nlayout(quads, ccw, ") + spacing +
             (points ? ", point_mode" : "") + ") in;\nout vec2 place;\n" +
             "void main() { place = gl_TessCoord.xy; gl_Position = vec4(0.0, 0.0, 0.0, 1.0); }\n");
  const char* captured = "place";
  glTransformFeedbackVaryings(program, 1, &captured, GL_INTERLEAVED_ATTRIBS);
  glLinkProgram(program);
  GLint good = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &good);
  if (!good) throw std::runtime_error("a tessellation program of the test does not link");
  return program;
}

}  // namespace

struct GlTessellator::State {
  std::array<GLuint, 3> points{}, triangles{};  // programs by spacing
  GLuint frame = 0, colour = 0, array = 0, buffer = 0, query = 0;
};

// Without a complete frame bound, draws are dropped, feedback and all.
GlTessellator::GlTessellator(const SoftwareGl&) : state_(std::make_unique<State>()) {
  for (std::size_t k = 0; k < 3; ++k) {
    state_->points[k] = make_program(kSpacings[k], true);
    state_->triangles[k] = make_program(kSpacings[k], false);
  }
  glCreateRenderbuffers(1, &state_->colour);
  glNamedRenderbufferStorage(state_->colour, GL_RGBA8, 16, 16);
  glCreateFramebuffers(1, &state_->frame);
  glNamedFramebufferRenderbuffer(state_->frame, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                 state_->colour);
  glCreateVertexArrays(1, &state_->array);
  glCreateBuffers(1, &state_->buffer);
  glNamedBufferStorage(state_->buffer, kMostCorners * sizeof(std::array<float, 2>), nullptr, 0);
  glCreateQueries(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, 1, &state_->query);
}

GlTessellator::~GlTessellator() {
  for (std::size_t k = 0; k < 3; ++k) {
    glDeleteProgram(state_->points[k]);
    glDeleteProgram(state_->triangles[k]);
  }
  glDeleteFramebuffers(1, &state_->frame);
  glDeleteRenderbuffers(1, &state_->colour);
  glDeleteVertexArrays(1, &state_->array);
  glDeleteBuffers(1, &state_->buffer);
  glDeleteQueries(1, &state_->query);
}

GlTessellation GlTessellator::tessellate(GlSpacing spacing, const std::array<float, 4>& outer,
                                         const std::array<float, 2>& inner) {
  glBindFramebuffer(GL_FRAMEBUFFER, state_->frame);
  glBindVertexArray(state_->array);
  glEnable(GL_RASTERIZER_DISCARD);
  glPatchParameteri(GL_PATCH_VERTICES, 1);
  glPatchParameterfv(GL_PATCH_DEFAULT_OUTER_LEVEL, outer.data());
  glPatchParameterfv(GL_PATCH_DEFAULT_INNER_LEVEL, inner.data());
  glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, state_->buffer);
  const auto capture = [&](GLuint program, GLenum kind, std::size_t corners) {
    glUseProgram(program);
    glBeginQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, state_->query);
    glBeginTransformFeedback(kind);
    glDrawArrays(GL_PATCHES, 0, 1);
    glEndTransformFeedback();
    glEndQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN);
    GLuint written = 0;
    glGetQueryObjectuiv(state_->query, GL_QUERY_RESULT, &written);
    std::vector<std::array<float, 2>> places(written * corners);
    glGetNamedBufferSubData(state_->buffer, 0,
                            static_cast<GLsizeiptr>(places.size() * sizeof(places[0])),
                            places.data());
    return places;
  };
  const auto k = static_cast<std::size_t>(spacing);
  GlTessellation result{capture(state_->points[k], GL_POINTS, 1),
                        capture(state_->triangles[k], GL_TRIANGLES, 3)};
  glDisable(GL_RASTERIZER_DISCARD);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  if (glGetError() != GL_NO_ERROR) throw std::runtime_error("OpenGL failed while tessellating");
  return result;
}

}  // namespace plumb::test_support
