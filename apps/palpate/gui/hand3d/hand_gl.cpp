#include "gui/hand3d/hand_gl.h"

#include <QOpenGLBuffer>
#include <QOpenGLContext>
#include <QOpenGLFunctions_3_3_Core>
#include <QOpenGLShaderProgram>
#include <QOpenGLVersionFunctionsFactory>
#include <QOpenGLVertexArrayObject>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace palpate::gui {

namespace {

// Colours are 0xAARRGGBB numbers; unpacking them in the shader is independent of the byte order.
constexpr const char* kUnpack = R"(
vec4 unpacked(uint argb) {
  return vec4((argb >> 16) & 255u, (argb >> 8) & 255u, argb & 255u, argb >> 24) / 255.0;
}
)";

constexpr const char* kSurfaceVertex = R"(
uniform mat4 clipFromBase;
uniform mat3 eyeFromBase;
uniform vec3 towardsLight;
uniform vec2 ambientDiffuse;
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in uint argb;
centroid out vec4 color;
void main() {
  gl_Position = clipFromBase * vec4(position, 1.0);
  float light = 1.0;
  if (dot(normal, normal) > 0.0)
    light = ambientDiffuse.x + ambientDiffuse.y * abs(dot(eyeFromBase * normal, towardsLight));
  vec4 own = unpacked(argb);
  color = vec4(min(own.rgb * light, vec3(1.0)), own.a);
}
)";

// Lines and points are already in clip space.
constexpr const char* kFlatVertex = R"(
layout(location = 0) in vec4 position;
layout(location = 1) in uint argb;
centroid out vec4 color;
void main() {
  gl_Position = position;
  color = unpacked(argb);
}
)";

constexpr const char* kFragment = R"(
centroid in vec4 color;
layout(location = 0) out vec4 drawn;
void main() { drawn = color; }
)";

QString source(const char* text) {
  return QStringLiteral("#version 330 core\n") + QLatin1String(text);
}

// Copies the triangles whose vertices are numbers; a normal that isn't a number becomes zero (not
// lit).
void copyNumbers(const std::vector<SceneVertex>& from, std::vector<SceneVertex>& to) {
  to.clear();
  for (std::size_t i = 0; i + 2 < from.size(); i += 3) {
    const std::size_t before = to.size();
    for (std::size_t k = 0; k < 3; ++k) {
      SceneVertex vertex = from[i + k];
      if (!isFinite(vertex)) vertex.normal = {};
      if (isFinite(vertex)) to.push_back(vertex);
    }
    if (to.size() != before + 3) to.resize(before);
  }
}

}  // namespace

struct HandGl::Gl {
  QOpenGLFunctions_3_3_Core* functions = nullptr;
  QOpenGLShaderProgram surface, flat;
  // A vertex buffer and its layout, for each kind of primitive.
  struct Kind {
    QOpenGLVertexArrayObject reading;
    QOpenGLBuffer buffer{QOpenGLBuffer::VertexBuffer};
    std::size_t numVertices = 0;
  };
  Kind solid, clear, flatTriangles;
  std::vector<SceneVertex> numbers;
  std::vector<ClipVertex> clipVertices;

  QString build(QOpenGLShaderProgram& program, const char* vertexText);
  QString buildAll();
  template <class Vertex>
  bool make(Kind& kind, void (Gl::*describe)());
  void describeSurface();
  void describeFlat();
  template <class Vertex>
  void fill(Kind& kind, const std::vector<Vertex>& vertices);
  void fillSurface(Kind& kind, const std::vector<SceneVertex>& vertices);
  void drawKind(Kind& kind);
};

HandGl::HandGl() = default;
HandGl::~HandGl() = default;

QString HandGl::Gl::build(QOpenGLShaderProgram& program, const char* vertexText) {
  const QString vertex = source(kUnpack) + QLatin1String(vertexText);
  if (!program.addShaderFromSourceCode(QOpenGLShader::Vertex, vertex) ||
      !program.addShaderFromSourceCode(QOpenGLShader::Fragment, source(kFragment)) ||
      !program.link()) {
    const QString log = program.log().simplified();
    return QStringLiteral("the driver doesn't accept shaders of OpenGL 3.3") +
           (log.isEmpty() ? QString() : QStringLiteral(": ") + log.left(200));
  }
  return {};
}

void HandGl::Gl::describeSurface() {
  constexpr auto kStride = static_cast<GLsizei>(sizeof(SceneVertex));
  const auto offset = [](std::size_t bytes) { return reinterpret_cast<const void*>(bytes); };
  for (GLuint i = 0; i < 3; ++i) functions->glEnableVertexAttribArray(i);
  functions->glVertexAttribPointer(
      0, 3, GL_FLOAT, GL_FALSE, kStride, offset(offsetof(SceneVertex, positionMm)));
  functions->glVertexAttribPointer(
      1, 3, GL_FLOAT, GL_FALSE, kStride, offset(offsetof(SceneVertex, normal)));
  functions->glVertexAttribIPointer(
      2, 1, GL_UNSIGNED_INT, kStride, offset(offsetof(SceneVertex, color)));
}

void HandGl::Gl::describeFlat() {
  constexpr auto kStride = static_cast<GLsizei>(sizeof(ClipVertex));
  const auto offset = [](std::size_t bytes) { return reinterpret_cast<const void*>(bytes); };
  for (GLuint i = 0; i < 2; ++i) functions->glEnableVertexAttribArray(i);
  functions->glVertexAttribPointer(
      0, 4, GL_FLOAT, GL_FALSE, kStride, offset(offsetof(ClipVertex, clip)));
  functions->glVertexAttribIPointer(
      1, 1, GL_UNSIGNED_INT, kStride, offset(offsetof(ClipVertex, color)));
}

template <class Vertex>
bool HandGl::Gl::make(Kind& kind, void (Gl::*describe)()) {
  if (!kind.reading.create() || !kind.buffer.create()) return false;
  kind.buffer.setUsagePattern(QOpenGLBuffer::StreamDraw);
  kind.reading.bind();
  kind.buffer.bind();
  (this->*describe)();
  kind.reading.release();
  kind.buffer.release();
  return true;
}

QString HandGl::Gl::buildAll() {
  for (const auto& [program, text] : {std::pair{&surface, kSurfaceVertex}, {&flat, kFlatVertex}})
    if (const QString why = build(*program, text); !why.isEmpty()) return why;
  if (!make<SceneVertex>(solid, &Gl::describeSurface) ||
      !make<SceneVertex>(clear, &Gl::describeSurface) ||
      !make<ClipVertex>(flatTriangles, &Gl::describeFlat))
    return QStringLiteral("the driver provides no vertex buffer");
  return {};
}

QString HandGl::initialize() {
  release();
  QOpenGLContext* context = QOpenGLContext::currentContext();
  if (!context) return QStringLiteral("there is no OpenGL context");
  const QSurfaceFormat format = context->format();
  if (context->isOpenGLES() || format.version() < std::pair(3, 3))
    return QStringLiteral("the driver offers OpenGL %1%2.%3, 3.3 is needed")
        .arg(QLatin1String(context->isOpenGLES() ? "ES " : ""))
        .arg(format.majorVersion())
        .arg(format.minorVersion());
  auto* functions = QOpenGLVersionFunctionsFactory::get<QOpenGLFunctions_3_3_Core>(context);
  if (!functions || !functions->initializeOpenGLFunctions())
    return QStringLiteral("the driver lacks functions of OpenGL 3.3");
  gl_ = std::make_unique<Gl>();
  gl_->functions = functions;
  const QString why = gl_->buildAll();
  if (!why.isEmpty()) release();
  return why;
}

void HandGl::release() { gl_.reset(); }

template <class Vertex>
void HandGl::Gl::fill(Kind& kind, const std::vector<Vertex>& vertices) {
  kind.numVertices = vertices.size() - vertices.size() % 3;
  if (kind.numVertices == 0) return;
  kind.buffer.bind();
  kind.buffer.allocate(vertices.data(), static_cast<int>(kind.numVertices * sizeof(Vertex)));
  kind.buffer.release();
}

void HandGl::Gl::fillSurface(Kind& kind, const std::vector<SceneVertex>& vertices) {
  if (std::all_of(vertices.begin(), vertices.end(), [](const SceneVertex& vertex) {
        return isFinite(vertex);
      }))
    return fill(kind, vertices);
  copyNumbers(vertices, numbers);
  fill(kind, numbers);
}

void HandGl::Gl::drawKind(Kind& kind) {
  kind.reading.bind();
  functions->glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(kind.numVertices));
  kind.reading.release();
}

void HandGl::draw(const HandScene& scene,
                  const HandCamera& camera,
                  const QSizeF& size,
                  double pixelRatio) {
  if (!gl_ || !(size.width() > 0.0) || !(size.height() > 0.0)) return;
  QOpenGLFunctions_3_3_Core& gl = *gl_->functions;
  gl_->fillSurface(gl_->solid, scene.solid);
  gl_->fillSurface(gl_->clear, scene.clear);
  gl_->clipVertices.clear();
  appendLinesAndPoints(scene, camera, size, gl_->clipVertices);
  gl_->fill(gl_->flatTriangles, gl_->clipVertices);

  const auto pixels = [&](double length) {
    return std::max(1, static_cast<int>(std::lround(length * pixelRatio)));
  };
  gl.glViewport(0, 0, pixels(size.width()), pixels(size.height()));
  gl.glDisable(GL_SCISSOR_TEST);
  gl.glDisable(GL_STENCIL_TEST);
  gl.glDisable(GL_CULL_FACE);
  gl.glDisable(GL_BLEND);
  gl.glEnable(GL_MULTISAMPLE);
  gl.glEnable(GL_DEPTH_TEST);
  gl.glDepthFunc(GL_LESS);
  gl.glDepthMask(GL_TRUE);
  gl.glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  const QColor ground = QColor::fromRgb(scene.background);
  gl.glClearColor(ground.redF(), ground.greenF(), ground.blueF(), 1.0F);
  gl.glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);

  const Eigen::Matrix4f clipFromBase =
      camera.clipFromBase(size.width() / size.height()).cast<float>();
  const Eigen::Matrix3f eyeFromBase = camera.eyeFromBase().cast<float>();
  gl_->surface.bind();
  gl.glUniformMatrix4fv(
      gl_->surface.uniformLocation("clipFromBase"), 1, GL_FALSE, clipFromBase.data());
  gl.glUniformMatrix3fv(
      gl_->surface.uniformLocation("eyeFromBase"), 1, GL_FALSE, eyeFromBase.data());
  gl_->surface.setUniformValue("towardsLight",
                               QVector3D(kTowardsLight.x(), kTowardsLight.y(), kTowardsLight.z()));
  gl_->surface.setUniformValue("ambientDiffuse", QVector2D(kAmbient, kDiffuse));
  gl_->drawKind(gl_->solid);

  gl.glEnable(GL_BLEND);
  gl.glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  gl_->flat.bind();
  gl_->drawKind(gl_->flatTriangles);

  gl_->surface.bind();
  gl.glDepthMask(GL_FALSE);
  gl.glEnable(GL_CULL_FACE);
  gl.glFrontFace(GL_CCW);
  for (const GLenum hidden : {GL_FRONT, GL_BACK}) {
    gl.glCullFace(hidden);
    gl_->drawKind(gl_->clear);
  }
  gl_->surface.release();
  gl.glCullFace(GL_BACK);
  gl.glDisable(GL_CULL_FACE);
  gl.glDisable(GL_BLEND);
  gl.glDisable(GL_DEPTH_TEST);
  gl.glDepthMask(GL_TRUE);
}

}  // namespace palpate::gui
