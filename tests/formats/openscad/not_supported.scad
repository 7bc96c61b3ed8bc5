cube(3);
hull() { cube(1); translate([3, 0, 0]) sphere(1); }
linear_extrude(height = 2, twist = 90) square(3);
translate([9, 0, 0]) minkowski() { cube(1); sphere(1); }
difference() {
  cube(9);
  rotate_extrude() translate([3, 0]) circle(1);
  linear_extrude(height = 3) text("say \"hi\"");
}
%hull() { cube(1); }
polyhedron(points = [[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0], [2, 2, 1], [2, 2, 4]],
           faces = [[0, 1, 5], [1, 2, 5], [2, 3, 5], [3, 0, 5], [1, 0, 4], [2, 1, 4], [3, 2, 4], [0, 3, 4]]);
