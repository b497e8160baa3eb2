* MI keeps the upper bound at +infinity: max x over x - y <= 4, y <= 6 gives 10, not 0.
NAME          MI
OBJSENSE
    MAXIMIZE
ROWS
 N  GAIN
 L  R1
COLUMNS
    X         GAIN                 1   R1                   1
    Y         R1                  -1
RHS
    RHS       R1                   4
BOUNDS
 MI BND       X
 UP BND       Y                    6
ENDATA
