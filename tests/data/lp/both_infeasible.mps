* Neither the program nor its dual is feasible: min -x - y, x - y <= -1, -x + y <= -1.
NAME BOTH FREE
ROWS
 N COST
 L R1
 L R2
COLUMNS
 X COST -1
 X R1 1
 X R2 -1
 Y COST -1
 Y R1 -1
 Y R2 1
RHS
 RHS R1 -1
 RHS R2 -1
ENDATA
