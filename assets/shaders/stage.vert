#version 330 core
// SPDX-License-Identifier: GPL-3.0-or-later
// A rectangle of the stage: floor, wall, or a bead with its image in the floor. Nothing but the place is interpolated.
layout(location = 0) in vec4 box;    // left, top, right, bottom, pixels
layout(location = 1) in vec4 disc;   // x, radius; left of the picture, part of a pixel by which the bead is further right
layout(location = 2) in vec4 rows;   // first rows of the bead's picture and of that of its image; size of both
layout(location = 3) in vec4 planes; // left and right contact: x at the floor, and further right for each pixel above it
layout(location = 4) in vec4 sides;  // nearness of the neighbours, tilt of the contacts
layout(location = 5) in vec3 light;  // of the contact at the left
layout(location = 6) in vec3 right;  // of that at the right
layout(location = 7) in vec3 own;    // of the whole bead; colour of the wall
uniform vec2 size;       // of the viewport
uniform vec3 rows_of_it; // of the stage; in software, flat inputs cost less than uniforms in each pixel

flat out vec4 ball, pictures, contacts, neighbours;
noperspective out vec2 place;
flat out vec2 level; // cosines of the tilts
flat out vec3 from_left, from_right, everywhere, stage;

void main()
{
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
    place = mix(box.xy, box.zw, corner);
    gl_Position = vec4(place / size * 2.0 - 1.0, 0.0, 1.0);
    ball = disc;
    pictures = rows;
    contacts = planes;
    neighbours = sides;
    level = sqrt(1.0 - sides.zw * sides.zw);
    from_left = light;
    from_right = right;
    everywhere = own;
    stage = rows_of_it;
}
