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
#ifdef MODEL
out vec2 map_at;
out vec4 tangent_W;
#endif
void main() {
  position_B = gl_Vertex.xyz;
#ifdef MODEL
  map_at = gl_MultiTexCoord0.xy;
  tangent_W = vec4(mat3(osg_ViewMatrixInverse) * (mat3(gl_ModelViewMatrix) * gl_MultiTexCoord1.xyz), gl_MultiTexCoord1.w);
#endif
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
uniform vec2 crop;  // lower edge and height of the drawn rows, as shares of the picture's height
uniform mat4 osg_ViewMatrixInverse;
uniform bool outdoors;
out vec3 above, below;
out float rise;  // of the line of sight: its sine
vec3 skyColor(float height);
vec3 openSky(float rise);
vec3 openSea(float rise);
vec3 toDisplay(vec3 linear);
void main() {
  gl_Position = vec4(gl_Vertex.xy, 1.0, 1.0);
  vec4 far = gl_ProjectionMatrixInverse * gl_Position;
  rise = normalize(mat3(osg_ViewMatrixInverse) * (far.xyz / far.w)).z;
  above = toDisplay(outdoors ? openSky(rise) : skyColor(crop.x + crop.y * (gl_Vertex.y * 0.5 + 0.5)));
  below = outdoors ? toDisplay(openSea(rise)) : above;
}
)";

constexpr const char* kBackground = R"(#version 130
in vec3 above, below;
in float rise;
void main() { gl_FragColor = vec4(rise < 0.0 ? below : above, 1.0); }
)";

constexpr const char* kSky = R"(#version 130
uniform float glow;
// the wall of a room, by the height in the picture
vec3 skyColor(float height) {
  return mix(vec3(0.300, 0.345, 0.400), vec3(0.030, 0.043, 0.065), smoothstep(0.05, 1.0, height));
}
// out of doors, by the sine of a line's elevation: haze over the horizon, then blue; in the evening a band of red
vec3 openSky(float rise) {
  float up = max(rise, 0.0);
  vec3 noon = mix(vec3(0.10, 0.24, 0.52), vec3(0.56, 0.66, 0.72), exp(-7.0 * up));
  vec3 dusk = mix(vec3(0.13, 0.20, 0.36), vec3(0.92, 0.52, 0.26), exp(-9.0 * up));
  return mix(noon, dusk, glow);
}
vec3 openSea(float rise) {
  vec3 deep = mix(vec3(0.045, 0.13, 0.24), vec3(0.10, 0.11, 0.16), glow);
  return mix(deep, openSky(0.0), 0.10 + 0.35 * exp(60.0 * rise));
}
vec3 toDisplay(vec3 linear) {
  // hue stays: the brightest channel is bent towards 1, the others follow
  float top = max(max(linear.r, linear.g), max(linear.b, 1e-6));
  float bent = top < 0.6 ? top : 1.0 - 0.4 * exp(-(top - 0.6) / 0.4);
  vec3 c = linear * (bent / top);
  return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
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

// What the ground looks like from afar.
constexpr const char* kLand = R"(#version 130
uniform vec3 key_direction;
vec3 daylight(vec3 n, float key, float open);
vec3 landColor(vec3 n) {
  vec3 albedo = mix(vec3(0.25, 0.23, 0.19), vec3(0.155, 0.150, 0.080), smoothstep(0.80, 0.97, n.z));
  return albedo * daylight(n, max(dot(n, key_direction), 0.0), 1.0);
}
)";

constexpr const char* kLight = R"(#version 130
uniform sampler2DShadow key_map;
uniform sampler2DShadow sky_map;
uniform mat4 key_matrix;
uniform mat4 sky_matrix;
uniform vec3 key_direction;
vec3 daylight(vec3 n, float key, float open);
// eight samples a pixel; a still picture has four pixels for each of its own
const vec2 kTaps[8] = vec2[](
  vec2(-0.942, -0.399), vec2(0.946, -0.769), vec2(-0.094, -0.929), vec2(0.345, 0.294),
  vec2(-0.814, 0.914), vec2(-0.265, -0.170), vec2(0.975, 0.756), vec2(-0.142, 0.897));

// share of light that arrives; blur [m] is the half width of the penumbra. Samples lie in the surface's own plane, so
// that a slanted surface does not shade itself.
float visibility(sampler2DShadow map, mat4 to_map, vec3 p, vec3 n, float blur) {
  vec3 c = (to_map * vec4(p, 1.0)).xyz;
  float turn = 6.2831853 * fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
  vec3 side = normalize(abs(n.z) < 0.7 ? cross(n, vec3(0, 0, 1)) : cross(n, vec3(1, 0, 0)));
  vec3 a = mat3(to_map) * (side * blur), b = mat3(to_map) * (cross(n, side) * blur);
  vec3 u = cos(turn) * a + sin(turn) * b, v = cos(turn) * b - sin(turn) * a;
  float sum = 0.0;
  for (int i = 0; i < 8; ++i) sum += texture(map, c + kTaps[i].x * u + kTaps[i].y * v);
  return sum / 8.0;
}

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

#ifdef MODEL
// n: with relief; face: of the surface, on which shadows fall
vec3 litModel(vec3 albedo, vec3 n, vec3 face, vec3 p, vec3 to_eye, float rough, float metal) {
  float facing = max(dot(face, key_direction), 0.0);
  float seen = facing > 0.0 ? keyShare(face, p) / facing * smoothstep(0.0, 0.15, facing) : 0.0;
  float key = max(dot(n, key_direction), 0.0) * seen, open = skyShare(face, p);
  float alpha = max(rough * rough, 0.03), power = 2.0 / (alpha * alpha) - 2.0;
  vec3 mirror = mix(vec3(0.04), albedo, metal), half_way = normalize(key_direction + to_eye);
  float lobe = (power + 2.0) / 8.0 * pow(max(dot(n, half_way), 0.0), power) * key;
  vec3 around = metal * mirror * daylight(reflect(-to_eye, n), 0.0, open);
  return albedo * (1.0 - metal) * daylight(n, key, open) + mirror * lobe + around;
}
#endif

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
}

vec3 earth(vec3 albedo, vec3 p) {
  vec3 near = texture(ground_map, 0.83 * p.xy).rgb;
  // turned and larger once more, so that the tile does not show
  float far = texture(ground_map, 0.31 * vec2(0.8 * p.x - 0.6 * p.y, 0.6 * p.x + 0.8 * p.y)).g;
  return albedo * 4.0 * near * near * (0.55 + 1.8 * far * far);
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

constexpr const char* kModel = R"(
uniform sampler2D color_map, normal_map, rough_map;
uniform float relief, roughness, metallic;
in vec2 map_at;
in vec4 tangent_W;
vec3 litModel(vec3 albedo, vec3 n, vec3 face, vec3 p, vec3 to_eye, float rough, float metal);
void main() {
  vec3 face = normalize(normal_W), n = face, albedo = base.rgb;
  float rough = roughness, metal = metallic;
#ifdef COLOR_MAP
  albedo *= texture(color_map, map_at).rgb;  // sRGB, decoded by the texture unit
#endif
#ifdef NORMAL_MAP
  vec3 n_T = texture(normal_map, map_at).rgb * 2.0 - 1.0;
  vec3 t = normalize(tangent_W.xyz - face * dot(face, tangent_W.xyz)), b = sign(tangent_W.w) * cross(face, t);
  n = normalize(relief * (n_T.x * t + n_T.y * b) + n_T.z * face);
#endif
#ifdef ROUGH_MAP
  vec3 shares = texture(rough_map, map_at).rgb;
  rough *= shares.g;
  metal *= shares.b;
#endif
  gl_FragColor = vec4(toDisplay(litModel(albedo, n, face, position_W, normalize(to_eye_W), rough, metal)), 1.0);
}
)";

constexpr const char* kFloor = R"(
uniform vec3 floor_center;
uniform float floor_radius;
uniform vec2 picture_size;
vec3 earth(vec3 albedo, vec3 p);
vec3 landColor(vec3 n);
void main() {
#if GRAIN == 2
  vec3 albedo = earth(base.rgb, position_W), background = landColor(vec3(0, 0, 1));
#else
  vec3 albedo = base.rgb * (1.0 - grid(position_W.xy)), background = skyColor(gl_FragCoord.y / picture_size.y);
#endif
  vec3 color = lit(albedo, vec3(0, 0, 1), position_W, normalize(to_eye_W), 0.0);
  float far = smoothstep(0.15, 1.0, length(position_W.xy - floor_center.xy) / floor_radius);
  gl_FragColor = vec4(toDisplay(mix(color, background, far)), 1.0);
}
)";

// Surfaces for software rendering: light is computed at the vertices, for a point in the sun, in its shadow, and under a
// cover, and combined with colours in display space, where the product is nearly the same. No powers or roots per pixel.
constexpr const char* kQuickVertex = R"(#version 130
uniform mat4 osg_ViewMatrixInverse;
uniform mat4 key_matrix;
uniform mat4 sky_matrix;
uniform vec3 key_direction;
uniform vec3 grain_offset;
out vec3 sunny, shaded, closed;
out vec3 key_at, sky_at;  // in the maps
out vec3 at;              // of the texture
#ifdef OPEN
out vec3 far_away;
#endif
#ifdef MODEL
out vec2 map_at;
#ifdef COLOR_MAP
uniform vec3 map_mean;
#endif
#ifdef NORMAL_MAP
out vec3 key_T;  // direction of the key light in the tangent frame
#endif
#endif
vec3 toDisplay(vec3 linear);
vec3 daylight(vec3 n, float key, float open);
vec3 landColor(vec3 n);
void main() {
  vec3 albedo = gl_Color.rgb;
#ifdef COLOR_MAP
  albedo *= map_mean;
#endif
  vec4 eye = gl_ModelViewMatrix * gl_Vertex;
  vec3 p = (osg_ViewMatrixInverse * eye).xyz;
  vec3 n = normalize(mat3(osg_ViewMatrixInverse) * (gl_NormalMatrix * gl_Normal));
  float key = max(dot(n, key_direction), 0.0);
  vec3 half_way = normalize(key_direction + normalize(osg_ViewMatrixInverse[3].xyz - p));
  float shine = GLOSS > 0.0 ? 0.5 * GLOSS * pow(max(dot(n, half_way), 0.0), 48.0) * key : 0.0;
  sunny = toDisplay(albedo * daylight(n, key, 1.0) + vec3(shine));
  shaded = toDisplay(albedo * daylight(n, 0.0, 1.0));
#ifdef OPEN
  far_away = toDisplay(landColor(vec3(0, 0, 1)));
#endif
  closed = toDisplay(albedo * daylight(n, 0.0, 1.0 - 0.72 * (0.5 + 0.5 * n.z)));
  key_at = (key_matrix * vec4(p + n * (0.0008 + 0.0015 * (1.0 - key)), 1.0)).xyz;
  sky_at = (sky_matrix * vec4(p + n * 0.0015, 1.0)).xyz;
  at = GRAIN == 1 ? gl_Vertex.xyz + grain_offset : vec3(p.xy, n.z > 0.99 ? 1.0 : 0.0);
#ifdef MODEL
  map_at = gl_MultiTexCoord0.xy;
#ifdef NORMAL_MAP
  vec3 t = mat3(osg_ViewMatrixInverse) * (mat3(gl_ModelViewMatrix) * gl_MultiTexCoord1.xyz);
  t = normalize(t - n * dot(n, t));
  key_T = vec3(dot(t, key_direction), gl_MultiTexCoord1.w * dot(cross(n, t), key_direction), dot(n, key_direction));
#endif
#endif
  gl_Position = gl_ProjectionMatrix * eye;
}
)";

constexpr const char* kQuickSurface = R"(#version 130
uniform sampler2D key_map;
uniform sampler2D sky_map;
uniform sampler3D grain_map;
uniform sampler2D ground_map;
in vec3 sunny, shaded, closed;
in vec3 key_at, sky_at;
in vec3 at;
#ifdef OPEN
in vec3 far_away;
#endif
#ifdef MODEL
in vec2 map_at;
#ifdef COLOR_MAP
uniform sampler2D color_map;
uniform vec3 map_gain;
#endif
#ifdef NORMAL_MAP
uniform sampler2D normal_map;
uniform float relief;
in vec3 key_T;
#endif
#endif
uniform vec3 floor_center;
uniform float floor_radius;
uniform vec2 picture_size;
vec3 skyColor(float height);
// Upper bound of the share of light (Chebyshev's inequality), from mean and mean square of the depths [m]; what is below
// a quarter would leak through where two shadows meet.
float share(sampler2D map, vec3 at) {
  vec2 depth = texture(map, at.xy).rg;
  float variance = max(depth.g - depth.r * depth.r, 2.3e-6);
  float below = max(at.z - depth.r, 0.0);
  return max(1.333 * variance / (variance + below * below) - 0.333, 0.0);
}
float gridLine(vec2 p, float spacing, float strength) {
  vec2 g = p / spacing;
  vec2 width = fwidth(g);
  vec2 away = abs(fract(g - 0.5) - 0.5) / max(width, vec2(1e-6));
  vec2 line = clamp(1.3 - 0.87 * away, 0.0, 1.0) * clamp(1.5 - 3.3 * width, 0.0, 1.0);
  return strength * max(line.x, line.y);
}
void main() {
#ifdef OPEN
  vec3 color = sunny;
#else
  float key = share(key_map, key_at);
#ifdef NORMAL_MAP
  // the share of the key light that the relief receives, relative to the surface without it
  vec3 n_T = texture(normal_map, map_at).rgb * 2.0 - 1.0;
  key *= clamp(dot(vec3(relief * n_T.xy, n_T.z), key_T) / max(key_T.z, 0.15), 0.0, 1.6);
#endif
  vec3 color = mix(mix(closed, shaded, share(sky_map, sky_at)), sunny, key);
#ifdef COLOR_MAP
  color *= map_gain * texture(color_map, map_at).rgb;
#endif
#endif
#if GRAIN == 1
  vec4 cloud = texture(grain_map, 5.5 * at);
  color *= (0.70 + 0.39 * cloud.r) * mix(vec3(1.0), vec3(0.89, 0.82, 0.72), 0.5 * cloud.a);
#elif GRAIN == 2
  color *= 2.0 * texture(ground_map, 0.83 * at.xy).rgb;
#elif GRID == 1
  color *= 1.0 - 0.5 * at.z * max(gridLine(at.xy, 0.05, 0.30), gridLine(at.xy, 0.25, 0.50));
#endif
#ifdef OPEN
#if GRAIN == 2
  vec3 sky = far_away;
#else
  vec3 sky = sqrt(skyColor(gl_FragCoord.y / picture_size.y));  // within 0.015 of its display colour, with the next line
  sky = 0.85 * sky + 0.15 * sqrt(sky);
#endif
  color = mix(color, sky, smoothstep(0.15, 1.0, length(at.xy - floor_center.xy) / floor_radius));
#endif
  gl_FragColor = vec4(color, 1.0);
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

// Small parts of smooth colour: computed at the vertices.
constexpr const char* kPlainVertex = R"(#version 130
uniform mat4 osg_ViewMatrixInverse;
uniform vec3 state_color;
uniform float opacity;
uniform float pressure;
uniform vec3 key_direction;
out vec4 color;
vec3 toDisplay(vec3 linear);
vec3 daylight(vec3 n, float key, float open);
vec3 openSky(float rise);
vec3 landColor(vec3 n);
vec4 glyph(vec3 n, vec3 to_eye) {
  float facing = 0.5 + 0.5 * dot(n, normalize(to_eye + vec3(0, 0, length(to_eye))));
  return vec4(toDisplay(gl_Color.rgb * mix(0.45, 1.25, facing)), opacity);
}
vec4 cone(vec3 n, vec3 to_eye) {
  float grazing = 1.0 - abs(dot(n, normalize(to_eye)));
  return vec4(toDisplay(state_color * 1.5), opacity * mix(0.7, 1.8, grazing * grazing));
}
vec4 skin(vec3 n, vec3 to_eye) {
  float rim = pow(1.0 - max(dot(n, normalize(to_eye)), 0.0), 2.2);
  vec3 pad = mix(gl_Color.rgb, vec3(1.0, 0.10, 0.04), pressure);
  vec3 albedo = mix(pad, state_color, 0.18 * (1.0 - pressure) + 0.72 * rim);
  return vec4(toDisplay(albedo * daylight(n, max(dot(n, key_direction), 0.0), 1.0)), mix(0.50, 0.95, rim));
}
vec4 land(vec3 n, vec3 to_eye) {
  float haze = 1.0 - exp(-0.018 * length(to_eye));
  return vec4(toDisplay(mix(landColor(n), openSky(0.0), haze)), 1.0);
}
void main() {
  vec4 eye = gl_ModelViewMatrix * gl_Vertex;
  vec3 n = normalize(mat3(osg_ViewMatrixInverse) * (gl_NormalMatrix * gl_Normal));
  color = COLOR(n, osg_ViewMatrixInverse[3].xyz - (osg_ViewMatrixInverse * eye).xyz);
  gl_Position = gl_ProjectionMatrix * eye;
}
)";

constexpr const char* kPlain = R"(#version 130
in vec4 color;
void main() { gl_FragColor = color; }
)";

// Distances on a plane: a colour, a fine line each `step`, a strong one at the surface.
constexpr const char* kSliceVertex = R"(#version 130
out vec2 at;
out vec2 place;  // [m]
void main() {
  at = gl_MultiTexCoord0.xy;
  place = gl_Vertex.xy;
  gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
}
)";
constexpr const char* kSlice = R"(#version 130
uniform sampler2D distances;  // [m]
uniform sampler2D palette;    // from -range to range
uniform float range;
uniform float step;
uniform float opacity;
in vec2 at;
in vec2 place;
float lineAt(float away, float pixel, float width) { return 1.0 - smoothstep(width - 0.5, width + 0.5, away / pixel); }
void main() {
  float d = texture(distances, at).r;
  float pixel = max(fwidth(d), 1e-9);
  vec3 color = texture(palette, vec2(0.5 + 0.5 * clamp(d / range, -1.0, 1.0), 0.5)).rgb;
  // no line where the field ends: there it jumps, which no distance does
  float steepest = 2.0 * (length(dFdx(place)) + length(dFdy(place)));
  float sound = pixel < steepest ? 1.0 : 0.0;
  float away = step * abs(fract(d / step + 0.5) - 0.5);
  float dense = abs(d) < range - 0.25 * step ? 1.0 - smoothstep(0.1, 0.35, pixel / step) : 0.0;
  color = mix(color, vec3(0.04, 0.06, 0.10), 0.42 * sound * dense * lineAt(away, pixel, 0.9));
  color = mix(color, vec3(0.0), sound * lineAt(abs(d), pixel, 2.2));
  gl_FragColor = vec4(color, opacity * (1.0 - smoothstep(0.5 * range, range, d)));
}
)";
constexpr const char* kLine = R"(#version 130
uniform vec4 line_color;
void main() { gl_FragColor = line_color; }
)";

constexpr const char* kCopyVertex = R"(#version 130
uniform vec4 part;  // lower left corner and size, as shares of the picture
out vec2 at;
void main() {
  at = part.xy + part.zw * gl_MultiTexCoord0.xy;
  gl_Position = vec4(gl_Vertex.xy, 0.0, 1.0);
}
)";

// mean and mean square of the depths in a square of texels; of every other one in a large square
constexpr const char* kMoments = R"(#version 130
uniform sampler2D source;
uniform float depth_range;
void main() {
  ivec2 corner = SIDE * ivec2(gl_FragCoord.xy);
  vec2 sum = vec2(0.0);
  for (int y = 0; y < SIDE; y += STEP)
    for (int x = 0; x < SIDE; x += STEP) {
      float depth = texelFetch(source, corner + ivec2(x, y), 0).r;
      sum += vec2(depth, depth * depth);
    }
  sum /= float(SIDE / STEP * (SIDE / STEP));
  gl_FragColor = vec4(sum.x * depth_range, sum.y * depth_range * depth_range, 0.0, 0.0);
}
)";

constexpr const char* kBlur = R"(#version 130
uniform sampler2D source;
in vec2 at;
void main() {
  vec2 texel = 1.0 / vec2(textureSize(source, 0)), sum = vec2(0.0);
  for (int y = -HALF; y < HALF; ++y)
    for (int x = -HALF; x < HALF; ++x) sum += texture(source, at + (vec2(x, y) + 0.5) * texel).rg;
  gl_FragColor = vec4(sum / float(4 * HALF * HALF), 0.0, 0.0);
}
)";

// The head-up display is multiplied by its opacity already. SMOOTH: both are up to twice as large as the picture, and a
// pixel is the mean of those that it covers, in linear light (nearly the square of a display colour).
constexpr const char* kOverlay = R"(#version 130
uniform sampler2D space;
uniform sampler2D hud;
in vec2 at;
vec3 both(vec3 under, vec4 over) { return under * (1.0 - over.a) + over.rgb; }
#ifdef SMOOTH
uniform float larger;  // so many times
vec3 light(ivec2 texel) {
  vec3 color = both(texelFetch(space, texel, 0).rgb, texelFetch(hud, texel, 0));
  return color * color;
}
void main() {
  vec2 middle = at * vec2(textureSize(space, 0)) - 0.5;
  ivec2 low = ivec2(middle);
  vec2 share = 0.5 + (middle - vec2(low) - 0.5) / larger;
  vec3 below = mix(light(low), light(low + ivec2(1, 0)), share.x);
  vec3 above = mix(light(low + ivec2(0, 1)), light(low + ivec2(1, 1)), share.x);
  gl_FragColor = vec4(sqrt(mix(below, above, share.y)), 1.0);
}
#else
void main() { gl_FragColor = vec4(both(texture(space, at).rgb, texture(hud, at)), 1.0); }
#endif
)";

/// `text` with definitions inserted after its first line, the version.
std::string defined(std::string text, const std::string& definitions) {
  return text.insert(text.find('\n') + 1, definitions);
}

osg::ref_ptr<osg::Shader> fragments(const std::string& text, const std::string& definitions) {
  return new osg::Shader(osg::Shader::FRAGMENT, defined(text, definitions));
}

/// Small parts whose colour is the function `color` of kPlainVertex.
osg::ref_ptr<osg::Program> plain(const std::string& color) {
  osg::ref_ptr<osg::Program> program = new osg::Program;
  program->setName(color);
  for (const char* part : {kSky, kDaylight, kLand}) program->addShader(new osg::Shader(osg::Shader::VERTEX, part));
  program->addShader(new osg::Shader(osg::Shader::VERTEX, defined(kPlainVertex, "#define COLOR " + color + "\n")));
  program->addShader(new osg::Shader(osg::Shader::FRAGMENT, kPlain));
  return program;
}

std::string grainOf(Material::Texture texture) {
  return "#define GRAIN " + std::to_string(static_cast<int>(texture)) + "\n";
}

std::string mapsOf(const Maps& maps) {
  return std::string("#define MODEL\n") + (maps.color ? "#define COLOR_MAP\n" : "") +
         (maps.normal ? "#define NORMAL_MAP\n" : "") + (maps.roughness ? "#define ROUGH_MAP\n" : "");
}

/// `more`: further definitions.
osg::ref_ptr<osg::Program> surface(const char* name, const char* main, Material::Texture texture = {},
                                   const std::string& more = {}) {
  const bool plain = texture == Material::Texture::kNone;
  const std::string definitions = grainOf(texture) + "#define GLOSS " + (plain ? "0.35" : "0.04") + "\n" + more;
  osg::ref_ptr<osg::Program> program = new osg::Program;
  program->setName(name);
  program->addShader(new osg::Shader(osg::Shader::VERTEX, defined(kVertex, definitions)));
  for (const char* part : {kSky, kDaylight, kLand, kLight}) program->addShader(fragments(part, definitions));
  if (!plain) program->addShader(fragments(kGrain, definitions));
  program->addShader(fragments(std::string(kSurfaceDeclarations) + main, definitions));
  return program;
}

osg::ref_ptr<osg::Program> quickSurface(const char* name, Material::Texture texture, bool shiny, bool grid,
                                        bool open = false, const std::string& more = {}) {
  const std::string definitions = grainOf(texture) + "#define GLOSS " + (shiny ? "0.35" : "0.0") + "\n" +
                                  (grid ? "#define GRID 1\n" : "") + (open ? "#define OPEN\n" : "") + more;
  osg::ref_ptr<osg::Program> program = new osg::Program;
  program->setName(name);
  for (const char* part : {kSky, kDaylight, kLand, kQuickVertex})
    program->addShader(new osg::Shader(osg::Shader::VERTEX, defined(part, definitions)));
  for (const char* part : {kSky, kQuickSurface}) program->addShader(fragments(part, definitions));
  return program;
}

osg::ref_ptr<osg::Program> program(const char* name, const char* vertices, const std::string& fragments) {
  osg::ref_ptr<osg::Program> program = new osg::Program;
  program->setName(name);
  program->addShader(new osg::Shader(osg::Shader::VERTEX, vertices));
  program->addShader(new osg::Shader(osg::Shader::FRAGMENT, fragments));
  return program;
}

/// Fills a picture in clip space.
osg::ref_ptr<osg::Program> copying(const char* name, const std::string& fragments) {
  return program(name, kCopyVertex, fragments);
}

}  // namespace

osg::ref_ptr<osg::Program> body(Material::Texture texture) { return surface("body", kBody, texture); }
osg::ref_ptr<osg::Program> quickBody(Material::Texture texture, bool grid) {
  return quickSurface("body", texture, texture == Material::Texture::kNone, grid);
}
osg::ref_ptr<osg::Program> model(const Maps& maps, bool quick) {
  return quick ? quickSurface("model", {}, false, false, false, mapsOf(maps))
               : surface("model", kModel, {}, mapsOf(maps));
}
osg::ref_ptr<osg::Program> floor(Material::Texture texture) { return surface("floor", kFloor, texture); }
osg::ref_ptr<osg::Program> quickFloor(Material::Texture texture, bool open) {
  return quickSurface("floor", texture, false, texture == Material::Texture::kNone, open);
}
osg::ref_ptr<osg::Program> skin(bool quick) { return quick ? plain("skin") : surface("skin", kSkin); }
osg::ref_ptr<osg::Program> glyph() { return plain("glyph"); }
osg::ref_ptr<osg::Program> cone() { return plain("cone"); }
osg::ref_ptr<osg::Program> land() { return plain("land"); }
osg::ref_ptr<osg::Program> slice() { return program("slice", kSliceVertex, kSlice); }
osg::ref_ptr<osg::Program> line() { return program("line", kSliceVertex, kLine); }

osg::ref_ptr<osg::Program> overlay(bool smooth) {
  return copying("overlay", smooth ? defined(kOverlay, "#define SMOOTH\n") : kOverlay);
}
osg::ref_ptr<osg::Program> moments(int side) {
  return copying("moments", defined(kMoments, "#define SIDE " + std::to_string(side) + "\n#define STEP " +
                                                  (side % 2 == 0 && side > 2 ? "2" : "1") + "\n"));
}
osg::ref_ptr<osg::Program> blur(int half_width) {
  return copying("blur", defined(kBlur, "#define HALF " + std::to_string(half_width) + "\n"));
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
