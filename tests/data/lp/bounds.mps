* min x1 + ... + x7 over bounds alone: -5 (negative UP with LO), -3 (LO), 0 (BV), 0 (UP 0), 2 (FX), and
* -4 (MI, held by the row x6 >= -4), 1.5 (LO and UP equal). The row "FREE" has no entries. Optimum -8.5.
NAME          BOUNDS
ROWS
 N  COST
 G  HOLD
 L  FREE
COLUMNS
    X1        COST                 1
    X2        COST                 1
    X3        COST                 1
    X4        COST                 1
    X5        COST                 1
    X6        COST                 1   HOLD                 1
    X7        COST                 1
RHS
    RHS       HOLD                -4
BOUNDS
 UP BND       X1                  -1
 LO BND       X1                  -5
 LO BND       X2                  -3
 BV BND       X3
 UP BND       X4                   0
 FX BND       X5                   2
 MI BND       X6
 LO BND       X7                 1.5
 UP BND       X7                 1.5
ENDATA
