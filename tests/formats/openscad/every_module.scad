// Every module the reader takes, each twelve units from the next along x; the test knows where.
cube([4, 6, 8], center = true);                                            // x = 0
translate([12, 0, 0]) sphere(r = 3);
translate([24, 0, 0]) cylinder(h = 5, r = 2);
translate([36, 0, 0]) cylinder(h = 6, r1 = 3, r2 = 1, center = true);
translate([48, 0, 0]) cylinder(h = 4, r = 3, $fn = 6);
translate([60, 0, 0]) sphere(r = 3, $fn = 8);
translate([72, 0, 0]) polyhedron(
  points = [[-3, -3, 0], [3, -3, 0], [3, 3, 0], [-3, 3, 0], [0, 0, 4]],
  faces = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4], [1, 0, 3], [2, 1, 3]]);
translate([84, 0, 0]) difference() {
  cube(6, center = true);
  color("red") cylinder(h = 8, r = 1.5, center = true);
  %sphere(r = 5);
  #translate([3, 3, 3]) sphere(r = 2);
}
translate([96, 0, 0]) intersection() {
  cube(6, center = true);
  sphere(r = 3.7);
  *cube(1);
}
translate([108, 0, 0]) union() {
  cube(2);
  render(convexity = 2) rotate([30, 40, 50]) translate([0, 0, -3]) cube([1, 1, 6]);
  if (false) cube(9);
}
translate([120, 0, 0]) mirror([1, 0, 0]) scale([1, 2, 0.5]) rotate([0, 0, 30]) cube([3, 1, 4]);
for (i = [0 : 1]) translate([132, 8 * i, 0]) color([0.25, 0.5, 0.75]) cube(2);
cube(0);
scale([1, 0, 1]) cube(3);
