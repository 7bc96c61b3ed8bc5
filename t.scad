render(convexity="x") cube(2);
multmatrix([[1,0,0,100],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) cube(size=[1,1,1],center=false);
