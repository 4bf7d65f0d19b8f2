// SPDX-License-Identifier: MIT
//
// A three.js material that samples a cube map whose faces are of a mapping, not gnomonic: where a direction is on its face is
// computed by the library's kernels, and the hardware looks up the direction that has those coordinates.

import { GLSL3, ShaderMaterial } from "three";

const vertexShader = `
out vec3 direction;
void main()
{
    direction = normal.zxy; // three's y is up, the Earth's axis is z
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;

/** The two lines of a mapped lookup are the second and the third of mapped(). */
const fragmentShader = (kernels, mapping) => `
precision highp samplerCube;
${kernels}
uniform samplerCube faces;
uniform bool isMapped;
in vec3 direction;
out vec4 color;

vec3 mapped(vec3 d)
{
    cm_face_point p = cm_cube_project(d.x, d.y, d.z);
    cm_uv uv = cm_${mapping}_forward(p.a, p.b, cm_${mapping}_prepare(cm_make_parameters(0.0, 0.0)));
    cm_xyz r = cm_cube_from_axes(p.face, 1.0, uv.u, uv.v);
    return vec3(r.x, r.y, r.z);
}

void main()
{
    vec3 d = normalize(direction);
    // derivatives of what is looked up break at edges; those of the direction do not, and have its size
    vec3 place = isMapped ? mapped(d) : d;
    color = textureGrad(faces, place / max(max(abs(place.x), abs(place.y)), abs(place.z)), dFdx(d), dFdy(d));
}`;

/** faces: a CubeTexture in the frame gl. kernels: the text of include/cubemap/kernel/backend.h for GLSL. mapping: one that has
 *  the symmetry of the square and no parameters, as coupled has. */
export function mappedMaterial({ faces, kernels, mapping = "coupled", isMapped = true }) {
    return new ShaderMaterial({
        glslVersion: GLSL3,
        uniforms: { faces: { value: faces }, isMapped: { value: isMapped } },
        vertexShader,
        fragmentShader: fragmentShader(kernels, mapping),
    });
}
