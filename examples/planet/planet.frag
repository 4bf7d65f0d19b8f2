/* SPDX-License-Identifier: MIT
 *
 * A planet seen from afar. What is special about its map are the two lines that begin with m; the kernels, with
 * cm_coupled_lookup, stand before this text (bindings/shaders/generate glsl-es coupled).
 */
uniform samplerCube ground;
uniform vec3 view; /* longitude and latitude that we look at, in degrees, and the size of the picture in pixels */
out vec4 colour;

void main()
{
    vec2 centre = radians(view.xy);
    vec3 towards = vec3(cos(centre.y) * cos(centre.x), cos(centre.y) * sin(centre.x), sin(centre.y));
    vec3 east = vec3(-sin(centre.x), cos(centre.x), 0.0);
    vec3 north = cross(towards, east);
    vec2 at = (2.0 * gl_FragCoord.xy / view.z - 1.0) * 0.285;
    vec3 ray = normalize(at.x * east + at.y * north - towards);
    vec3 eye = 4.0 * towards;
    float along = dot(eye, ray);
    float hit = along * along - dot(eye, eye) + 1.0;
    /* beside the planet the nearest point of its edge, so that derivatives are those of one surface */
    vec3 d = normalize(eye + (-along - sqrt(max(hit, 0.0))) * ray);

    cm_constants k = cm_coupled_constants();
    vec3 m = cm_coupled_lookup(d, k);
    vec3 land = textureGrad(ground, m, cm_coupled_lookup_step(d, dFdx(d), k), cm_coupled_lookup_step(d, dFdy(d), k)).rgb;

    float day = dot(d, normalize(towards + 0.9 * north - 0.7 * east));
    float haze = pow(1.0 - dot(d, -ray), 3.0);
    vec3 lit = pow(land, vec3(2.2)) * (0.03 + 1.5 * max(day, 0.0)) + vec3(0.25, 0.45, 0.9) * haze * max(day + 0.2, 0.0);
    float edge = smoothstep(-1.5, 1.5, hit / fwidth(hit));
    colour = vec4(pow(edge * lit, vec3(1.0 / 2.2)), 1.0);
}
