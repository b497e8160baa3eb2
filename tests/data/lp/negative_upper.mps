* A negative UP alone frees the column below: min x over x <= -2, x + y >= -7, y <= 3. Optimum -10.
NAME          NEGUP
ROWS
 N  COST
 G  R1
COLUMNS
    X         COST                 1   R1                   1
    Y         R1                   1
RHS
    RHS       R1                  -7
BOUNDS
 UP BND       X                   -2
 UP BND       Y                    3
ENDATA
