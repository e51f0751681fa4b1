#include "modules/view_osg/shaders.h"

#include <string>

namespace presa::view::shaders {
namespace {

constexpr const char* kVertex = R"(#version 130
uniform mat4 osg_ViewMatrixInverse;
out vec3 position_W;
out vec3 normal_W;
out vec3 to_eye_W;
out vec4 base;
out vec3 position_B;
void main() {
  position_B = gl_Vertex.xyz;
  vec4 eye = gl_ModelViewMatrix * gl_Vertex;
  position_W = (osg_ViewMatrixInverse * eye).xyz;
  normal_W = mat3(osg_ViewMatrixInverse) * (gl_NormalMatrix * gl_Normal);
  to_eye_W = osg_ViewMatrixInverse[3].xyz - position_W;
  base = gl_Color;
  gl_Position = gl_ProjectionMatrix * eye;
}
)";

// colour per vertex: software rendering has no time for powers at each pixel of the sky
constexpr const char* kBackgroundVertex = R"(#version 130
out vec3 color;
vec3 skyColor(float height);
vec3 toDisplay(vec3 linear);
void main() {
  color = toDisplay(skyColor(gl_Vertex.y * 0.5 + 0.5));
  gl_Position = vec4(gl_Vertex.xy, 1.0, 1.0);
}
)";

constexpr const char* kSky = R"(#version 130
uniform bool outdoors;
vec3 skyColor(float height) {
  vec3 low = outdoors ? vec3(0.46, 0.50, 0.52) : vec3(0.300, 0.345, 0.400);
  vec3 high = outdoors ? vec3(0.060, 0.150, 0.330) : vec3(0.030, 0.043, 0.065);
  return mix(low, high, smoothstep(0.05, 1.0, height));
}
vec3 toDisplay(vec3 linear) {
  // hue stays: the brightest channel is bent towards 1, the others follow
  float top = max(max(linear.r, linear.g), max(linear.b, 1e-6));
#ifdef QUICK
  // within 0.015 of what follows; roots are cheap, powers are not
  float over = max(top - 0.6, 0.0);
  vec3 root = sqrt(linear * ((min(top, 0.6) + over / (1.0 + 2.5 * over)) / top));
  return 0.85 * root + 0.15 * sqrt(root);
#else
  float bent = top < 0.6 ? top : 1.0 - 0.4 * exp(-(top - 0.6) / 0.4);
  vec3 c = linear * (bent / top);
  return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
#endif
}
)";

constexpr const char* kDaylight = R"(#version 130
uniform vec3 key_direction;
uniform float glow;
// on a surface: share of the key light, and of the sky
vec3 daylight(vec3 n, float key, float open) {
  vec3 sky = mix(vec3(0.16, 0.15, 0.15), vec3(0.30, 0.34, 0.40), 0.5 + 0.5 * n.z) * open;
  vec3 fill = vec3(0.08, 0.10, 0.14) * max(dot(n, normalize(vec3(0.8, -0.3, 0.25))), 0.0);
  return mix(vec3(0.98, 0.93, 0.85), vec3(1.55, 1.16, 0.66), glow) * key + sky + fill;
}
)";

constexpr const char* kLight = R"(#version 130
uniform sampler2DShadow key_map;
uniform sampler2DShadow sky_map;
uniform mat4 key_matrix;
uniform mat4 sky_matrix;
uniform vec3 key_direction;
uniform int taps;
vec3 daylight(vec3 n, float key, float open);
const vec2 kTaps[16] = vec2[](
  vec2(-0.942, -0.399), vec2(0.946, -0.769), vec2(-0.094, -0.929), vec2(0.345, 0.294),
  vec2(-0.916, 0.458), vec2(-0.815, -0.879), vec2(-0.383, 0.277), vec2(0.975, 0.756),
  vec2(0.443, -0.975), vec2(0.537, -0.474), vec2(-0.265, -0.419), vec2(0.792, 0.191),
  vec2(-0.242, 0.997), vec2(-0.814, 0.914), vec2(0.200, 0.786), vec2(0.143, -0.141));

// share of light that arrives; blur [m] is the half width of the penumbra. Samples lie in the surface's own plane, so
// that a slanted surface does not shade itself.
#ifdef OPEN
float visibility(sampler2DShadow map, mat4 to_map, vec3 p, vec3 n, float blur) { return 1.0; }
#elif defined(QUICK)
float visibility(sampler2DShadow map, mat4 to_map, vec3 p, vec3 n, float blur) {
  vec3 c = (to_map * vec4(p, 1.0)).xyz;
  vec2 inside = step(vec2(0.0), c.xy) * step(c.xy, vec2(1.0));
  c.z = min(c.z, 1.0) * inside.x * inside.y;  // beyond the map nothing is in the way
  return texture(map, c);
}
#else
float visibility(sampler2DShadow map, mat4 to_map, vec3 p, vec3 n, float blur) {
  vec3 c = (to_map * vec4(p, 1.0)).xyz;
  if (any(lessThan(c, vec3(0.0))) || any(greaterThan(c, vec3(1.0)))) return 1.0;
  float turn = 6.2831853 * fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
  vec3 side = normalize(abs(n.z) < 0.7 ? cross(n, vec3(0, 0, 1)) : cross(n, vec3(1, 0, 0)));
  vec3 a = mat3(to_map) * (side * blur), b = mat3(to_map) * (cross(n, side) * blur);
  vec3 u = cos(turn) * a + sin(turn) * b, v = cos(turn) * b - sin(turn) * a;
  float sum = 0.0;
  for (int i = 0; i < taps; ++i) sum += texture(map, c + kTaps[i].x * u + kTaps[i].y * v);
  return sum / float(taps);
}
#endif

float keyShare(vec3 n, vec3 p) {
  float facing = dot(n, key_direction);
  float margin = 0.0008 + 0.0015 * (1.0 - max(facing, 0.0));
  return facing > 0.0 ? facing * visibility(key_map, key_matrix, p + n * margin, n, 0.0035) : 0.0;
}
float skyShare(vec3 n, vec3 p) {
  return mix(1.0, visibility(sky_map, sky_matrix, p + n * 0.0015, n, 0.022), 0.72 * (0.5 + 0.5 * n.z));
}
vec3 lit(vec3 albedo, vec3 n, vec3 p, vec3 to_eye, float gloss) {
  float key = keyShare(n, p);
  vec3 half_way = normalize(key_direction + to_eye);
  float shine = gloss > 0.0 ? 0.5 * gloss * pow(max(dot(n, half_way), 0.0), 48.0) * key : 0.0;
  return albedo * daylight(n, key, skyShare(n, p)) + vec3(shine);
}

float gridLine(vec2 p, float spacing, float strength) {
  vec2 g = p / spacing;
  vec2 width = fwidth(g);
  vec2 away = abs(fract(g - 0.5) - 0.5) / max(width, vec2(1e-6));
  vec2 line = (1.0 - smoothstep(0.35, 1.5, away)) * (1.0 - smoothstep(0.15, 0.45, width));
  return strength * max(line.x, line.y);
}
float grid(vec2 p) { return max(gridLine(p, 0.05, 0.30), gridLine(p, 0.25, 0.50)); }
)";

constexpr const char* kSurfaceDeclarations = R"(#version 130
in vec3 position_W;
in vec3 normal_W;
in vec3 to_eye_W;
in vec4 base;
vec3 skyColor(float height);
vec3 toDisplay(vec3 linear);
vec3 lit(vec3 albedo, vec3 n, vec3 p, vec3 to_eye, float gloss);
float grid(vec2 p);
)";

constexpr const char* kGrain = R"(#version 130
uniform sampler3D grain_map;
uniform sampler2D ground_map;

// lengths in metres: clouds over a hand's width, grain of millimetres
vec3 stone(vec3 albedo, vec3 p, inout vec3 n, vec3 position_W) {
  vec4 cloud = texture(grain_map, p * 5.5);
#ifdef QUICK
  return albedo * (0.48 + 0.70 * cloud.r) * mix(vec3(1.0), vec3(0.78, 0.66, 0.50), 0.5 * cloud.a);
#else
  float fine = texture(grain_map, p * 42.0 + 0.3).r;
  float pit = smoothstep(0.42, 0.22, texture(grain_map, p * 17.0 + 0.7).r);
  albedo *= 0.50 + 0.72 * cloud.r;
  albedo = mix(albedo, albedo * vec3(0.78, 0.66, 0.50), 0.5 * cloud.a);
  albedo *= (0.80 + 0.36 * fine) * (1.0 - 0.45 * pit);
  // a bump, from how the grain changes across the picture
  float height = 0.0005 * fine - 0.0008 * pit;
  vec3 dx = dFdx(position_W), dy = dFdy(position_W);
  vec3 r1 = cross(dy, n), r2 = cross(n, dx);
  float area = dot(dx, r1);
  vec3 slope = sign(area) * (dFdx(height) * r1 + dFdy(height) * r2);
  n = normalize(max(abs(area), 1e-12) * n - slope);
  return albedo;
#endif
}

vec3 earth(vec3 albedo, vec3 p) {
  vec3 near = texture(ground_map, 0.83 * p.xy).rgb;
#ifdef QUICK
  return albedo * 4.0 * near * near;
#else
  // turned and larger once more, so that the tile does not show
  float far = texture(ground_map, 0.31 * vec2(0.8 * p.x - 0.6 * p.y, 0.6 * p.x + 0.8 * p.y)).g;
  return albedo * 4.0 * near * near * (0.55 + 1.8 * far * far);
#endif
}
)";

constexpr const char* kBody = R"(
uniform float grid_strength;
uniform vec3 grain_offset;
in vec3 position_B;
vec3 stone(vec3 albedo, vec3 p, inout vec3 n, vec3 position_W);
vec3 earth(vec3 albedo, vec3 p);
void main() {
  vec3 n = normalize(normal_W);
  vec3 albedo = base.rgb;
#if GRAIN == 1
  albedo = stone(albedo, position_B + grain_offset, n, position_W);
#elif GRAIN == 2
  albedo = earth(albedo, position_W);
#endif
  if (n.z > 0.99) albedo *= 1.0 - grid_strength * grid(position_W.xy);
  gl_FragColor = vec4(toDisplay(lit(albedo, n, position_W, normalize(to_eye_W), GLOSS)), 1.0);
}
)";

constexpr const char* kFloor = R"(
uniform vec3 floor_center;
uniform float floor_radius;
uniform vec2 picture_size;
vec3 earth(vec3 albedo, vec3 p);
void main() {
#if GRAIN == 2
  vec3 albedo = earth(base.rgb, position_W);
#else
  vec3 albedo = base.rgb * (1.0 - grid(position_W.xy));
#endif
  vec3 color = lit(albedo, vec3(0, 0, 1), position_W, normalize(to_eye_W), 0.0);
  float far = smoothstep(0.15, 1.0, length(position_W.xy - floor_center.xy) / floor_radius);
  gl_FragColor = vec4(toDisplay(mix(color, skyColor(gl_FragCoord.y / picture_size.y), far)), 1.0);
}
)";

// Earth for software rendering: light and colour are combined in display space, where the product is nearly the same,
// so that no square root is needed per pixel.
constexpr const char* kQuickEarthVertex = R"(#version 130
uniform mat4 osg_ViewMatrixInverse;
uniform vec3 key_direction;
out vec3 position_W;
out vec3 sunny, shaded, closed;
out vec2 tile;
vec3 toDisplay(vec3 linear);
vec3 daylight(vec3 n, float key, float open);
void main() {
  vec4 eye = gl_ModelViewMatrix * gl_Vertex;
  position_W = (osg_ViewMatrixInverse * eye).xyz;
  vec3 up = vec3(0, 0, 1);
  sunny = 2.0 * toDisplay(gl_Color.rgb * daylight(up, key_direction.z, 1.0));
  shaded = 2.0 * toDisplay(gl_Color.rgb * daylight(up, 0.0, 1.0));
  closed = 2.0 * toDisplay(gl_Color.rgb * daylight(up, 0.0, 0.28));
  tile = 0.83 * position_W.xy;
  gl_Position = gl_ProjectionMatrix * eye;
}
)";

constexpr const char* kQuickEarth = R"(#version 130
uniform sampler2D ground_map;
uniform sampler2DShadow key_map;
uniform sampler2DShadow sky_map;
uniform mat4 key_matrix;
uniform mat4 sky_matrix;
uniform vec3 floor_center;
uniform float floor_radius;
uniform vec2 picture_size;
in vec3 position_W;
in vec3 sunny, shaded, closed;
in vec2 tile;
vec3 skyColor(float height);
vec3 toDisplay(vec3 linear);
void main() {
  vec3 color = texture(ground_map, tile).rgb;
#ifdef OPEN
  float far = smoothstep(0.15, 1.0, length(position_W.xy - floor_center.xy) / floor_radius);
  gl_FragColor = vec4(mix(color * sunny, toDisplay(skyColor(gl_FragCoord.y / picture_size.y)), far), 1.0);
#else
  vec4 p = vec4(position_W, 1.0);
  float key = texture(key_map, (key_matrix * p).xyz), open = texture(sky_map, (sky_matrix * p).xyz);
  gl_FragColor = vec4(color * mix(mix(closed, shaded, open), sunny, key), 1.0);
#endif
}
)";

constexpr const char* kSkin = R"(
uniform vec3 state_color;
uniform float pressure;
void main() {
  vec3 n = normalize(normal_W), e = normalize(to_eye_W);
  float rim = pow(1.0 - max(dot(n, e), 0.0), 2.2);
  // the pad glows with the force, the rim tells whether it sticks
  vec3 pad = mix(base.rgb, vec3(1.0, 0.10, 0.04), pressure);
  vec3 color = lit(mix(pad, state_color, 0.18 * (1.0 - pressure) + 0.72 * rim), n, position_W, e, 0.5);
  gl_FragColor = vec4(toDisplay(color), mix(0.50, 0.95, rim));
}
)";

constexpr const char* kGlyph = R"(
uniform float opacity;
void main() {
  float facing = 0.5 + 0.5 * dot(normalize(normal_W), normalize(to_eye_W + vec3(0, 0, length(to_eye_W))));
  gl_FragColor = vec4(toDisplay(base.rgb * mix(0.45, 1.25, facing)), opacity);
}
)";

constexpr const char* kCone = R"(
uniform vec3 state_color;
uniform float opacity;
void main() {
  vec3 n = normalize(normal_W);
  float grazing = 1.0 - abs(dot(n, normalize(to_eye_W)));
  gl_FragColor = vec4(toDisplay(state_color * 1.5), opacity * mix(0.7, 1.8, grazing * grazing));
}
)";

constexpr const char* kBackground = R"(#version 130
in vec3 color;
void main() { gl_FragColor = vec4(color, 1.0); }
)";

constexpr const char* kCopyVertex = R"(#version 130
out vec2 at;
void main() {
  at = gl_MultiTexCoord0.xy;
  gl_Position = vec4(gl_Vertex.xy, 0.0, 1.0);
}
)";

constexpr const char* kCopy = R"(#version 130
uniform sampler2D picture;
in vec2 at;
void main() { gl_FragColor = texture(picture, at); }
)";

/// `text` with definitions inserted after its first line, the version.
osg::ref_ptr<osg::Shader> fragments(std::string text, const std::string& definitions) {
  text.insert(text.find('\n') + 1, definitions);
  return new osg::Shader(osg::Shader::FRAGMENT, text);
}

osg::ref_ptr<osg::Program> surface(const char* name, const char* main, Material::Texture texture = {},
                                   bool quick = false, bool open = false) {
  osg::ref_ptr<osg::Program> program = new osg::Program;
  program->setName(name);
  const std::string definitions = std::string(quick ? "#define QUICK\n" : "") +
                                  (texture == Material::Texture::kNone ? "#define GLOSS 0.35\n"
                                   : quick                             ? "#define GLOSS 0.0\n"
                                                                       : "#define GLOSS 0.04\n") +
                                  (open ? "#define OPEN\n" : "") +
                                  ("#define GRAIN " + std::to_string(static_cast<int>(texture))) + "\n";
  program->addShader(new osg::Shader(osg::Shader::VERTEX, kVertex));
  for (const char* part : {kSky, kDaylight, kLight}) program->addShader(fragments(part, definitions));
  if (texture != Material::Texture::kNone) program->addShader(fragments(kGrain, definitions));
  program->addShader(fragments(std::string(kSurfaceDeclarations) + main, definitions));
  return program;
}

osg::ref_ptr<osg::Program> quickEarth(bool open) {
  osg::ref_ptr<osg::Program> program = new osg::Program;
  program->setName("quick earth");
  const std::string definitions = std::string("#define QUICK\n") + (open ? "#define OPEN\n" : "");
  for (const char* part : {kSky, kDaylight, kQuickEarthVertex})
    program->addShader(new osg::Shader(osg::Shader::VERTEX, part));
  for (const char* part : {kSky, kQuickEarth}) program->addShader(fragments(part, definitions));
  return program;
}

}  // namespace

osg::ref_ptr<osg::Program> body(Material::Texture texture, bool quick) {
  return surface("body", kBody, texture, quick);
}
osg::ref_ptr<osg::Program> floor(Material::Texture texture, bool quick, bool open) {
  if (quick && texture == Material::Texture::kEarth) return quickEarth(open);
  return surface("floor", kFloor, texture, quick, open);
}
osg::ref_ptr<osg::Program> skin() { return surface("skin", kSkin); }
osg::ref_ptr<osg::Program> glyph() { return surface("glyph", kGlyph); }
osg::ref_ptr<osg::Program> cone() { return surface("cone", kCone); }

osg::ref_ptr<osg::Program> copy() {
  osg::ref_ptr<osg::Program> program = new osg::Program;
  program->setName("copy");
  program->addShader(new osg::Shader(osg::Shader::VERTEX, kCopyVertex));
  program->addShader(new osg::Shader(osg::Shader::FRAGMENT, kCopy));
  return program;
}

osg::ref_ptr<osg::Program> background() {
  osg::ref_ptr<osg::Program> program = new osg::Program;
  program->setName("background");
  program->addShader(new osg::Shader(osg::Shader::VERTEX, kBackgroundVertex));
  program->addShader(new osg::Shader(osg::Shader::VERTEX, kSky));
  program->addShader(new osg::Shader(osg::Shader::FRAGMENT, kBackground));
  return program;
}

}  // namespace presa::view::shaders
