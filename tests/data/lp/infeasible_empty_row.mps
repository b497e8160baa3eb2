* A row without entries that should equal 1.
NAME EMPTYROW FREE
ROWS
 N COST
 E E1
COLUMNS
 X COST 1
RHS
 RHS E1 1
ENDATA
