* Fixed columns and an interval of zero width: x = 2, y = -1, x + y + z = 4 leaves z = 3; min z = 3.
NAME ZEROWIDTH FREE
ROWS
 N COST
 E SUM
COLUMNS
 X SUM 1
 Y SUM 1
 Z SUM 1
 Z COST 1
RHS
 RHS SUM 4
BOUNDS
 FX BND X 2
 LO BND Y -1
 UP BND Y -1
ENDATA
