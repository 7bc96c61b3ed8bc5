// A bearing bracket: countersunk screw holes, a hexagonal nut trap on each side, ribs from polyhedra.
module screw_hole() {
  translate([0, 0, -1]) cylinder(h = 8, r = 2.2);
  translate([0, 0, 3.4]) cylinder(h = 2.7, r1 = 2.2, r2 = 4.9);
}

module rib()
  polyhedron(points = [[0, -2, 0], [16, -2, 0], [0, -2, 22], [0, 2, 0], [16, 2, 0], [0, 2, 22]],
             faces = [[0, 1, 2], [3, 5, 4], [0, 3, 4, 1], [1, 4, 5, 2], [2, 5, 3, 0]]);

module plate() difference() {
  union() {
    translate([-32, -18, 0]) cube([64, 36, 6]);
    for (x = [-32, 32]) translate([x, 0, 0]) cylinder(h = 6, r = 18);
  }
  for (x = [-38, 38], y = [-9, 9]) translate([x, y, 0]) screw_hole();
}

module tower() difference() {
  union() {
    translate([-14, -10, 0]) cube([28, 20, 34]);
    translate([0, 0, 34]) rotate([90, 0, 0]) cylinder(h = 20, r = 14, center = true);
  }
  translate([0, 0, 34]) rotate([90, 0, 0]) cylinder(h = 30, r = 8, center = true);
  for (side = [-1, 1]) translate([side * 14, 0, 16]) rotate([0, 90, 0])
    cylinder(h = 8, r = 4, center = true, $fn = 6);
}

color("lightsteelblue") {
  plate();
  tower();
  translate([14, 0, 6]) rib();
  mirror([1, 0, 0]) translate([14, 0, 6]) rib();
}
color("goldenrod") translate([0, 0, 34]) rotate([90, 0, 0]) difference() {
  cylinder(h = 22, r = 8, center = true);
  cylinder(h = 23, r = 5.5, center = true);
}
