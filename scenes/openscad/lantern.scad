// A lantern: a glass globe (see-through, so the whole file becomes one solid) round a candle, an eight-sided roof.
color([0.6, 0.85, 1, 0.3]) difference() {
  translate([0, 0, 16]) sphere(r = 13);
  translate([0, 0, 16]) sphere(r = 12.4);
  translate([0, 0, -4]) cube([40, 40, 18], center = true);
  translate([0, 0, 36]) cube([40, 40, 18], center = true);
}
color("ivory") translate([0, 0, 4]) cylinder(h = 13, r = 3.5);
color("orange") translate([0, 0, 17.5]) scale([1, 1, 2]) sphere(r = 1.6);
color([0.2, 0.2, 0.22]) {
  cylinder(h = 5, r1 = 14, r2 = 11);
  translate([0, 0, 27]) cylinder(h = 10, r1 = 15, r2 = 2, $fn = 8);
  for (a = [45 : 90 : 315]) rotate([0, 0, a]) translate([13.2, 0, 2]) cylinder(h = 26, r = 0.8);
  translate([0, 0, 38]) difference() {
    scale([1, 0.3, 1]) sphere(r = 4);
    scale([1, 1, 1]) rotate([90, 0, 0]) cylinder(h = 10, r = 2.4, center = true);
  }
}
