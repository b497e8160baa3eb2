* Feasible and unbounded: min -x - y, x - y <= 1.
NAME RAY FREE
ROWS
 N COST
 L R1
COLUMNS
 X COST -1
 X R1 1
 Y COST -1
 Y R1 -1
RHS
 RHS R1 1
ENDATA
