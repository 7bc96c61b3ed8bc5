// Two dice: rounded by an intersection with a sphere, pips cut by spheres.
module pip(x, y) translate([x, y, 10]) sphere(r = 1.9);

module face(n) {
  if (n % 2 == 1) pip(0, 0);
  if (n > 1) { pip(-5, -5); pip(5, 5); }
  if (n > 3) { pip(-5, 5); pip(5, -5); }
  if (n == 6) { pip(-5, 0); pip(5, 0); }
}

// The outermost color() wins, so the body's stands inside, beside that of the pips.
module die(body) difference() {
  color(body) intersection() {
    cube(20, center = true);
    sphere(r = 14);
  }
  color("white") {
    face(1);
    rotate([0, 90, 0]) face(2);
    rotate([90, 0, 0]) face(3);
    rotate([-90, 0, 0]) face(4);
    rotate([0, -90, 0]) face(5);
    rotate([180, 0, 0]) face(6);
  }
}

translate([-14, 0, 10]) rotate([0, 0, 15]) die("firebrick");
translate([14, 6, 10]) rotate([0, 90, 40]) die([0.15, 0.25, 0.5]);
color("seagreen") translate([0, 0, -1]) cube([90, 70, 2], center = true);
