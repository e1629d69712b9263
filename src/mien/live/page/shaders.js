/** Light on every pixel, by the formulas of mien.render.lighting; the background; and from linear light to sRGB. */

/** Most lamps that a scene of a page has. */
export const MOST_LAMPS = 8;

export const SURFACE_VERTEX = `#version 300 es
uniform mat4 projection;
in vec3 point;
in vec3 normal;
in vec3 color;
out vec3 place;
out vec3 direction;
out vec3 own;
void main() {
  place = point;
  direction = normal;
  own = color;
  gl_Position = projection * vec4(point, 1.0);
}`;

export const SURFACE_FRAGMENT = `#version 300 es
precision highp float;
uniform vec3 viewer;
uniform vec3 ambient[2];
uniform int lampCount;
uniform vec4 lampPlace[${MOST_LAMPS}];
uniform vec3 lampColor[${MOST_LAMPS}];
uniform float cosinePower;
uniform vec3 material;
in vec3 place;
in vec3 direction;
in vec3 own;
out vec4 pixel;
void main() {
  float gloss = material.x, power = material.y;
  if (material.z == 0.0) {
    pixel = vec4(own, 1.0);
    return;
  }
  vec3 n = normalize(gl_FrontFacing ? direction : -direction);
  vec3 eye = normalize(viewer - place);
  vec3 diffuse = mix(ambient[0], ambient[1], (n.y + 1.0) * 0.5);
  vec3 highlight = vec3(0.0);
  for (int i = 0; i < lampCount; i++) {
    vec3 lamp = normalize(lampPlace[i].xyz - place);
    float cosine = dot(n, lamp), wrap = lampPlace[i].w;
    float amount = max((cosine + wrap) / (1.0 + wrap), 0.0);
    diffuse += lampColor[i] * pow(amount, cosinePower);
    if (gloss > 0.0 && cosine > 0.0) {
      float shine = max(dot(n, normalize(lamp + eye)), 0.0);
      highlight += lampColor[i] * (gloss * pow(shine, power));
    }
  }
  pixel = vec4(own * diffuse + highlight, 1.0);
}`;

export const WHOLE_VERTEX = `#version 300 es
out float up;
void main() {
  vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  up = (corner.y + 1.0) * 0.5;
  gl_Position = vec4(corner, 0.0, 1.0);
}`;

export const BACKGROUND_FRAGMENT = `#version 300 es
precision highp float;
uniform vec4 ends[2];
in float up;
out vec4 pixel;
void main() {
  vec4 behind = mix(ends[0], ends[1], up);
  pixel = vec4(behind.rgb * behind.a, behind.a);
}`;

/** Canvases are mixed with their page by codes of sRGB: what is multiplied by alpha there is the code. */
export const SHOW_FRAGMENT = `#version 300 es
precision highp float;
uniform sampler2D picture;
out vec4 pixel;
vec3 toSrgb(vec3 light) {
  vec3 share = clamp(light, 0.0, 1.0);
  return mix(1.055 * pow(share, vec3(1.0 / 2.4)) - 0.055, 12.92 * share, lessThanEqual(share, vec3(0.0031308)));
}
void main() {
  vec4 linear = texelFetch(picture, ivec2(gl_FragCoord.xy), 0);
  pixel = vec4(toSrgb(linear.rgb / max(linear.a, 1e-6)) * linear.a, linear.a);
}`;
