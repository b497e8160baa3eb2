* Empty rows and columns: min x - y with x >= 1, y <= 5; row E1 has no entries and RHS 0. Optimum -4.
NAME EMPTY FREE
ROWS
 N COST
 E E1
 G G1
 L L1
COLUMNS
 X COST 1
 X G1 1
 Y COST -1
 Y L1 1
 Z E1 0
RHS
 RHS G1 1
 RHS L1 5
ENDATA
